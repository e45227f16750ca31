import { defineConfig } from 'vite';

export default defineConfig({
  // Relative addresses: the page works in any folder of any static host.
  base: './',
  build: {
    target: 'es2023',
    // Under the page's policy nothing may come from a data: address, and no script may be inline.
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 800,
    rolldownOptions: { input: ['index.html', 'turning.html'] },
  },
  worker: { format: 'es' },
});
