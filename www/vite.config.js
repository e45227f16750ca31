import { createHash } from 'node:crypto';
import { readdirSync, readFileSync } from 'node:fs';
import { defineConfig } from 'vite';

/** Writes the service worker: it keeps all that the page consists of, in a cache named after its content. */
function service() {
  return {
    name: 'service',
    generateBundle(_, bundle) {
      const version = createHash('sha256');
      const names = Object.keys(bundle).sort();
      // The names of assets tell their content; the page's own name does not.
      version.update(names.join());
      for (const name of names.filter((name) => name.endsWith('.html'))) version.update(bundle[name].source);
      const fixed = readdirSync('public').sort();
      for (const name of fixed) version.update(readFileSync(`public/${name}`));
      // Other pages, and what is loaded for whoever looks closely, are kept when they are first used.
      const isOther = (name) => {
        const { source, moduleIds = [] } = bundle[name] ?? {};
        const others = /\/www\/(learn|machine|study|turning)\//;
        // A worker is a file without modules: the functions that it calls tell whose it is.
        return (
          /\.(html|jpg)$|turning|learn|machine|study/.test(name) ||
          (moduleIds.length > 0 && moduleIds.every((id) => others.test(id))) ||
          (typeof source === 'string' && name.endsWith('.js') && /study_|turning_|machines_/.test(source))
        );
      };
      const first = [...names, ...fixed].filter((name) => !isOther(name));
      const files = ['./', ...first.map((name) => `./${name}`)];
      const source = readFileSync('service.js', 'utf8')
        .replace('__VERSION__', version.digest('hex').slice(0, 16))
        .replace('__FILES__', JSON.stringify(files));
      this.emitFile({ type: 'asset', fileName: 'service.js', source });
    },
  };
}

export default defineConfig({
  // Relative addresses: the page works in any folder of any static host.
  base: './',
  build: {
    target: 'es2023',
    // Under the page's policy nothing may come from a data: address, and no script may be inline.
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 800,
    rolldownOptions: { input: ['index.html', 'learn.html', 'turning.html'] },
  },
  plugins: [service()],
  worker: { format: 'es' },
});
