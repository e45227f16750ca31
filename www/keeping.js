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

/** @typedef {{ tab: string, time: number, draft: Draft }} Kept */

/** @returns {Promise<IDBDatabase>} */
function database() {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open(DATABASE, 1);
    request.onupgradeneeded = () => request.result.createObjectStore(STORE, { keyPath: 'tab' });
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}

/**
 * @template T
 * @param {IDBTransactionMode} mode
 * @param {(store: IDBObjectStore) => IDBRequest<T>} act
 * @returns {Promise<T>}
 */
async function within(mode, act) {
  const open = await database();
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
 * @param {{ onFull: () => void }} callbacks `onFull` once, when the browser has no room.
 */
export function createKeeping({ onFull }) {
  const tab = nameOfTab();
  /** @type {Draft | null} */
  let kept = null;
  let timer = 0;
  let isFull = false;

  /** @param {Draft} draft */
  async function write(draft) {
    try {
      await within('readwrite', (store) => store.put({ tab, time: Date.now(), draft }));
      isFull = false;
    } catch (error) {
      // Whoever forbids storage knows; a full disk is news.
      const isQuota = error instanceof DOMException && error.name === 'QuotaExceededError';
      if (isQuota && !isFull) onFull();
      isFull = isQuota;
    }
  }

  return {
    /** Keeps a draft soon, unless it is kept. @param {Draft | null} draft */
    update(draft) {
      if (!draft || draft === kept) return;
      kept = draft;
      clearTimeout(timer);
      timer = setTimeout(write, REST_MS, draft);
    },

    /** What this tab, or else whichever was last, had kept. @returns {Promise<Draft | null>} */
    async restore() {
      try {
        /** @type {Kept[]} */
        const all = await within('readonly', (store) => store.getAll());
        all.sort((a, b) => b.time - a.time);
        for (const { tab } of all.slice(MOST_TABS)) await within('readwrite', (store) => store.delete(tab));
        const found = all.find((one) => one.tab === tab) ?? all[0];
        return found?.draft ?? null;
      } catch {
        return null;
      }
    },
  };
}
