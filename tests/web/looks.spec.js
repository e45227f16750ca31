/** The page at the sizes and in the colours that people have: nothing overflows, and it looks as it did when people looked. */
import { controlsOverSurface, expect, expectToLookAs, picture, proof, test, visit } from './harness.js';

const SIZES = {
  desktop: { width: 1440, height: 900 },
  tablet: { width: 1024, height: 768 },
  phone: { width: 390, height: 844 },
};

for (const sizes of [['desktop', 'tablet'], ['phone']]) {
  test(`${sizes.join(' and ')}, light and dark: nothing overflows`, async ({ browser }) => {
    test.setTimeout(240_000);
    const phone = sizes.includes('phone');
    const viewport = SIZES[sizes[0]];
    const context = await browser.newContext({ viewport, hasTouch: phone, isMobile: phone });
    const page = await context.newPage();
    await visit(page);
    await proof(page);
    for (const size of sizes) {
      await page.setViewportSize(SIZES[size]);
      for (const colorScheme of ['light', 'dark']) {
        await page.emulateMedia({ colorScheme });
        await page.waitForTimeout(300);
        await picture(page, `${size}-${colorScheme}`);
        await expectToLookAs(page, `${size}-${colorScheme}`);
        const [inner, scroll] = await page.evaluate(() => [innerWidth, document.documentElement.scrollWidth]);
        expect(scroll).toBeLessThanOrEqual(inner);
        expect(inner).toBe(SIZES[size].width);
      }
    }
    await context.close();
  });
}

for (const size of ['desktop', 'phone']) {
  test(`${size}: no control lies over the part, as it is first seen and after Fit`, async ({ page }) => {
    test.setTimeout(240_000);
    await page.setViewportSize(SIZES[size]);
    await visit(page);
    for (const surface of ['Wave', 'Blade']) {
      await page.locator('#source button', { hasText: surface }).click();
      expect(await proof(page)).toBe(true);
      const first = await controlsOverSurface(page);
      expect(first.all).toBeGreaterThan(4000);
      expect(first.covered).toEqual([]);
      await page.locator('.cube button[data-side=front]').evaluate((face) => face.click());
      await page.locator('#views button', { hasText: 'Fit' }).click();
      const fitted = await controlsOverSurface(page);
      expect(fitted.all).toBeGreaterThan(1000);
      expect(fitted.covered).toEqual([]);
    }
  });
}
