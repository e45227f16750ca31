/** How the cutter leans, shown on the surface and at the cutter. */
import { expect, number, picture, set, test, visit } from './harness.js';

const tint = (page) => page.locator('select[name=tint]');
const told = (page, id) => page.locator(`#contact [data-figure="${id}"] dd`);

test('lead, yaw and strip are seen on the surface, and why the cutter leans so where it is clicked', async ({
  page,
}) => {
  await visit(page);
  // As it was given: the same everywhere.
  await tint(page).selectOption('lead');
  await expect(page.locator('#legend')).toContainText('Lead, °');
  await expect(told(page, 'lead')).toHaveText('8.0°');
  await expect(page.locator('#contact .why')).toHaveText('Lead and yaw were given.');

  await set(page, 'strategy.rule', 'widest');
  await set(page, 'strategy.least_lead_deg', 3);
  await page.locator('button[name=plan]').click();
  await expect(page.locator('html')).toHaveAttribute('data-job', 'plan');
  await expect(page.locator('html')).not.toHaveAttribute('data-job', 'plan', { timeout: 100_000 });
  for (const name of ['lead', 'yaw', 'strip']) {
    await tint(page).selectOption(name);
    const ends = page.locator('#legend .numbers span');
    const [low, high] = [number(await ends.first().textContent()), number(await ends.last().textContent())];
    expect(high, name).toBeGreaterThan(low);
    await picture(page, `tint-${name}`);
  }

  // The surface lies in the middle of the picture.
  const before = await page.locator('#scrub output').textContent();
  await page.locator('#canvas canvas').click();
  await expect(page.locator('#scrub output')).not.toHaveText(before ?? '');
  expect(number(await told(page, 'lead').textContent())).toBeGreaterThanOrEqual(3);
  expect(number(await told(page, 'strip').textContent())).toBeGreaterThan(0.5);
  await expect(page.locator('#contact .why')).toHaveText(/least lead|With less lead|neighbours/);
  await page.locator('#contact').scrollIntoViewIfNeeded();
  await picture(page, 'contact');

  // Excess comes back with the proof's colours.
  await tint(page).selectOption('excess');
  await expect(page.locator('#legend')).toContainText('Excess, µm');
});
