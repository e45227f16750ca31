/** The page at the sizes and in the colours that people have: nothing overflows, and a picture is kept. */
import { expect, picture, test, visit } from './harness.js';

for (const [size, viewport] of Object.entries({
  desktop: { width: 1440, height: 900 },
  tablet: { width: 1024, height: 768 },
  phone: { width: 390, height: 844 },
})) {
  for (const colorScheme of ['light', 'dark']) {
    test(`${size}, ${colorScheme}: nothing overflows`, async ({ browser }) => {
      const phone = size === 'phone';
      const context = await browser.newContext({ viewport, colorScheme, hasTouch: phone, isMobile: phone });
      const page = await context.newPage();
      await visit(page);
      await page.waitForTimeout(500);
      await picture(page, `${size}-${colorScheme}`);
      const [inner, scroll] = await page.evaluate(() => [innerWidth, document.documentElement.scrollWidth]);
      expect(scroll).toBeLessThanOrEqual(inner);
      expect(inner).toBe(viewport.width);
      await context.close();
    });
  }
}
