/** Has the browser keep the page for when there is no network, and tells of a new version. */

/** @param {() => void} [onNew] When another version is there; {@link update} goes over to it. */
export async function keepOffline(onNew = () => {}) {
  if (!import.meta.env.PROD || !('serviceWorker' in navigator)) return;
  try {
    const registration = await navigator.serviceWorker.register(new URL('./service.js', document.baseURI));
    const tell = () => registration.waiting && navigator.serviceWorker.controller && onNew();
    tell();
    registration.addEventListener('updatefound', () => {
      registration.installing?.addEventListener('statechange', tell);
    });
    const { active } = await navigator.serviceWorker.ready;
    await controlled();
    // What was loaded before there was anybody to keep it: pages, but for the planner's, are kept by being used.
    const used = performance.getEntriesByType('resource').map(({ name }) => name);
    const page = location.origin + location.pathname;
    active?.postMessage([page, ...used.filter((name) => name.startsWith(location.origin))]);
  } catch {
    // Where it is forbidden the page works as long as there is a network.
  }
}

export async function update() {
  const registration = await navigator.serviceWorker.getRegistration();
  navigator.serviceWorker.addEventListener('controllerchange', () => location.reload());
  registration?.waiting?.postMessage('update');
}

/** Waits until what this page loads from now on is kept. */
function controlled() {
  return new Promise((resolve) => {
    if (navigator.serviceWorker.controller) resolve(null);
    else navigator.serviceWorker.addEventListener('controllerchange', resolve, { once: true });
  });
}
