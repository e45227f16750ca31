/** Stepover against tilt. */
import { expect, number, picture, test, visit } from './harness.js';

const cell = (page, tilt, column) =>
  page
    .locator('.chart tbody tr', { has: page.locator(`th:text-is("${tilt}")`) })
    .locator('td')
    .nth(column);

test('the chart of stepover against tilt follows cutter, scallop and surface', async ({ page }) => {
  await visit(page);
  await page.locator('[name="cutter.diameter_mm"]').fill('25');
  await page.locator('[name="cutter.corner_radius_mm"]').fill('3');
  await page.locator('[name="tolerance.scallop_mm"]').fill('0.01');
  await page.locator('button[name=chart]').click();
  const dialog = page.getByRole('dialog', { name: 'Stepover and tilt' });
  await dialog.locator('.frame path.lead').waitFor();

  // A hollow of 50 mm: two contacts a third wider than at curvature match.
  await page.locator('[name="chart.radius"]').fill('50');
  await dialog.getByText('As a table').click();
  await expect(cell(page, '11.66°', 1)).toHaveText('9.015');
  await expect(cell(page, '10.48°', 0)).toHaveText('12.377');
  await expect(cell(page, '0°', 1)).toHaveText('–');
  await picture(page, 'chart');

  // On a plane there is neither, and the value at a tilt that the keyboard chooses is read out.
  await page.locator('[name="chart.shape"]').selectOption('plane');
  await expect(dialog.locator('.curves .two')).toHaveCount(0);
  const slider = page.locator('[name="chart.at"]');
  await slider.focus();
  await page.keyboard.press('End');
  await expect(slider).toHaveAttribute('aria-valuetext', '60°');
  await expect(dialog.locator('.curves .lead dd')).toHaveText('1.06 mm');
  const [exact, circle] = await Promise.all([0, 1].map((column) => cell(page, '5°', column).textContent()));
  expect(number(circle)).toBeGreaterThan(number(exact));

  await page.keyboard.press('Escape');
  await expect(dialog).toBeHidden();
  await expect(page.locator('button[name=chart]')).toBeFocused();
});
