/** A million path points: turned fluidly, and drawn only when something changed. */
import { expect, test } from './harness.js';

const POINTS = 1_000_000;

/** Slowest frame that still follows a hand, milliseconds; what draws here is a processor, and often a shared one. */
const SLOWEST = 1000;

/** Gives every planned path a million points instead, and counts what is drawn. */
function enlarge(points) {
  const raster = () => {
    const path = new Float32Array(8 * points);
    const contacts = new Float32Array(3 * points);
    const across = Math.sqrt(points);
    let length = 0;
    for (let i = 0; i < points; i += 1) {
      const pass = Math.floor(i / across);
      const along = (i - pass * across) / across;
      const x = 60 * (pass % 2 ? 1 - along : along) - 30;
      const point = [x, 40 * (pass / across) - 20, 4.5 * Math.sin(0.1 * x)];
      length += 60 / across;
      contacts.set(point, 3 * i);
      path.set([...point, 0, 0, 1, 0, length], 8 * i);
    }
    return { path, contacts };
  };
  window.Worker = class extends Worker {
    constructor(...args) {
      super(...args);
      this.addEventListener(
        'message',
        ({ data }) => data.result?.path && Object.assign(data.result, raster()),
      );
    }
  };
  window.drawn = 0;
  for (const name of ['drawArrays', 'drawElements']) {
    const draw = WebGL2RenderingContext.prototype[name];
    WebGL2RenderingContext.prototype[name] = function counted(...args) {
      window.drawn += 1;
      return draw.apply(this, args);
    };
  }
}

test('a million path points follow the hand, and rest when nothing moves', async ({ page }, {
  annotations,
}) => {
  test.setTimeout(240_000);
  await page.addInitScript(enlarge, POINTS);
  await page.goto('./');
  await page.locator('.verdict').waitFor({ timeout: 200_000 });
  const frames = await page.locator('#canvas canvas').evaluate(async (canvas) => {
    const next = () => new Promise((resolve) => requestAnimationFrame(resolve));
    const times = [];
    for (let i = 0; i < 9; i += 1) {
      const start = performance.now();
      canvas.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowRight' }));
      // The second frame waits until the first is on the screen.
      await next();
      await next();
      times.push(Math.round(performance.now() - start));
    }
    return times.sort((a, b) => a - b);
  });
  annotations.push({ type: 'frames, ms', description: frames.join(' ') });
  expect(frames[4]).toBeLessThan(SLOWEST);
  await page.waitForTimeout(1500);
  const before = await page.evaluate(() => window.drawn);
  await page.waitForTimeout(500);
  expect(await page.evaluate(() => window.drawn)).toBe(before);
});
