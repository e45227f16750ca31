/** Both languages: the system's at first, the other by a switch that keeps the work. */
import { expect, picture, set, test } from './harness.js';

test('中文 by the system, English by the switch, and the work is kept', async ({ browser }) => {
  const context = await browser.newContext({ locale: 'zh-CN', viewport: { width: 1440, height: 900 } });
  const page = await context.newPage();
  await page.goto('./');
  await page.locator('html[data-ready]').waitFor();
  await expect(page.locator('#action button.primary')).toContainText('规划');
  await expect(page.locator('html')).toHaveAttribute('lang', 'zh-CN');
  await page.locator('.verdict').waitFor();
  await expect(page.locator('.verdict')).toContainText('µm');
  await picture(page, 'chinese');
  await set(page, 'cutter.diameter_mm', 9);
  await page.waitForTimeout(600);
  await page.locator('button[name=language]').click();
  await expect(page.locator('#action button.primary')).toContainText('Plan');
  await expect(page.locator('[name="cutter.diameter_mm"]')).toHaveValue('9');
  await context.close();
});
