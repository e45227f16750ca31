/**
 * Keeps the page for when there is no network: every file of one version, and no file of another.
 *
 * The bundler fills in the list and its version. A new version waits until the page that runs has gone, or its reader asks.
 */

const VERSION = '__VERSION__';
/** @type {string[]} */
const FILES = JSON.parse('__FILES__');

const NAME = `stepover-${VERSION}`;
const worker = /** @type {any} */ (globalThis);

worker.addEventListener('install', (/** @type {any} */ event) => {
  event.waitUntil(caches.open(NAME).then((cache) => cache.addAll(FILES)));
});

worker.addEventListener('activate', (/** @type {any} */ event) => {
  event.waitUntil(
    caches.keys().then((names) => {
      const old = names.filter((name) => name.startsWith('stepover-') && name !== NAME);
      return Promise.all(old.map((name) => caches.delete(name)));
    }),
  );
  // A first visit, too, is kept from here on.
  event.waitUntil(worker.clients.claim());
});

worker.addEventListener('message', (/** @type {any} */ event) => {
  if (event.data === 'update') worker.skipWaiting();
  else if (Array.isArray(event.data)) event.waitUntil(keep(event.data));
});

/** Keeps what a page was loaded from. @param {string[]} addresses */
async function keep(addresses) {
  const cache = await caches.open(NAME);
  for (const address of addresses) {
    if (await cache.match(address, { ignoreSearch: true })) continue;
    // What is gone already was not needed.
    await cache.add(address).catch(() => {});
  }
}

worker.addEventListener('fetch', (/** @type {any} */ event) => {
  if (event.request.method !== 'GET') return;
  const answer = async () => {
    const cache = await caches.open(NAME);
    const found = await cache.match(event.request, { ignoreSearch: true });
    if (found) return found;
    const fetched = await fetch(event.request);
    // What a first visit does not need, such as the turning page, is kept once it was used.
    if (fetched.ok && new URL(event.request.url).origin === location.origin) {
      await cache.put(event.request, fetched.clone());
    }
    return fetched;
  };
  event.respondWith(answer());
});
