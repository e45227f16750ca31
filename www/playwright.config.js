import { fileURLToPath } from 'node:url';
import { defineConfig } from '@playwright/test';

const output = '../tests/web/output';

export default defineConfig({
  testDir: '../tests/web',
  testMatch: '*.spec.js',
  outputDir: `${output}/playwright`,
  reporter: 'list',
  // WebGL is drawn in software here: more than two pages at once only wait for one another.
  workers: 2,
  // Real files take minutes: they must not wait for one another.
  fullyParallel: true,
  retries: 0,
  timeout: 120_000,
  expect: { timeout: 60_000 },
  use: {
    baseURL: process.env.BASE_URL ?? 'http://127.0.0.1:8080/',
    viewport: { width: 1440, height: 900 },
    launchOptions: {
      executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
      // A machine without a font for Chinese would show boxes.
      env: {
        ...process.env,
        FONTCONFIG_FILE: fileURLToPath(new URL('../tests/web/fonts.conf', import.meta.url)),
      },
      args: [
        '--no-sandbox',
        '--disable-gpu',
        '--disable-quic',
        '--no-first-run',
        '--disable-background-networking',
        '--disable-component-update',
        '--disable-sync',
      ],
    },
  },
});
