/** Has the browser keep the page for when there is no network, and tells of a new version. */

/** @param {() => void} onNew When another version is there; {@link update} goes over to it. */
export async function keepOffline(onNew) {
  if (!import.meta.env.PROD || !('serviceWorker' in navigator)) return;
  try {
    const registration = await navigator.serviceWorker.register(new URL('./service.js', document.baseURI));
    const tell = () => registration.waiting && navigator.serviceWorker.controller && onNew();
    tell();
    registration.addEventListener('updatefound', () => {
      registration.installing?.addEventListener('statechange', tell);
    });
  } catch {
    // Where it is forbidden the page works as long as there is a network.
  }
}

export async function update() {
  const registration = await navigator.serviceWorker.getRegistration();
  navigator.serviceWorker.addEventListener('controllerchange', () => location.reload());
  registration?.waiting?.postMessage('update');
}
