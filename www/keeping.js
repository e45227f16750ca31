/**
 * Keeps what a person works on in this browser, so that nothing is lost on reload: settings and the surface's file.
 *
 * Two tabs do not disturb one another: each keeps its own under a name that lives as long as the tab; a new tab goes on with
 * what was kept last.
 *
 * @import { Draft } from './types.js'
 */

const DATABASE = 'stepover';
const STORE = 'drafts';
/** Tabs of which something is kept. */
const MOST_TABS = 6;
/** Edits that follow one another faster are written once. */
const REST_MS = 400;

/** @template D @typedef {{ tab: string, time: number, draft: D }} Kept */

/** @param {string} name @returns {Promise<IDBDatabase>} */
function database(name) {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open(name, 1);
    request.onupgradeneeded = () => request.result.createObjectStore(STORE, { keyPath: 'tab' });
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}

/**
 * @template T
 * @param {string} name
 * @param {IDBTransactionMode} mode
 * @param {(store: IDBObjectStore) => IDBRequest<T>} act
 * @returns {Promise<T>}
 */
async function within(name, mode, act) {
  const open = await database(name);
  try {
    return await new Promise((resolve, reject) => {
      const transaction = open.transaction(STORE, mode);
      const request = act(transaction.objectStore(STORE));
      transaction.oncomplete = () => resolve(request.result);
      transaction.onabort = () => reject(transaction.error);
    });
  } finally {
    open.close();
  }
}

/** A name that a reload keeps; a duplicated tab is one tab with its original until either is edited. */
function nameOfTab() {
  try {
    const known = sessionStorage.getItem('tab');
    const name = known ?? crypto.randomUUID();
    sessionStorage.setItem('tab', name);
    return name;
  } catch {
    return 'only';
  }
}

/**
 * @template [D=Draft]
 * @param {{ onFull: () => void }} callbacks `onFull` once, when the browser has no room.
 * @param {string} [name] Of the database: each page has its own.
 */
export function createKeeping({ onFull }, name = DATABASE) {
  const tab = nameOfTab();
  /** @type {D | null} */
  let kept = null;
  let timer = 0;
  let isFull = false;

  /** @param {D} draft */
  async function write(draft) {
    try {
      await within(name, 'readwrite', (store) => store.put({ tab, time: Date.now(), draft }));
      isFull = false;
    } catch (error) {
      // Whoever forbids storage knows; a full disk is news.
      const isQuota = error instanceof DOMException && error.name === 'QuotaExceededError';
      if (isQuota && !isFull) onFull();
      isFull = isQuota;
    }
  }

  return {
    /** Keeps a draft soon, unless it is kept. @param {D | null} draft */
    update(draft) {
      if (!draft || draft === kept) return;
      kept = draft;
      clearTimeout(timer);
      timer = setTimeout(write, REST_MS, draft);
    },

    /** What this tab, or else whichever was last, had kept. @returns {Promise<D | null>} */
    async restore() {
      try {
        /** @type {Kept<D>[]} */
        const all = await within(name, 'readonly', (store) => store.getAll());
        all.sort((a, b) => b.time - a.time);
        for (const { tab } of all.slice(MOST_TABS))
          await within(name, 'readwrite', (store) => store.delete(tab));
        const found = all.find((one) => one.tab === tab) ?? all[0];
        return found?.draft ?? null;
      } catch {
        return null;
      }
    },
  };
}
