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
const FILES = 'files';
/** Tabs of which something is kept. */
const MOST_TABS = 6;
/** Edits that follow one another faster are written once. */
const REST_MS = 400;

/** @template D @typedef {{ tab: string, time: number, draft: D }} Kept */

/** @param {string} name @returns {Promise<IDBDatabase>} */
function database(name) {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open(name, 2);
    request.onupgradeneeded = () => {
      const { result } = request;
      if (!result.objectStoreNames.contains(STORE)) result.createObjectStore(STORE, { keyPath: 'tab' });
      if (!result.objectStoreNames.contains(FILES)) result.createObjectStore(FILES, { keyPath: 'name' });
    };
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}

/**
 * @template T
 * @param {string} name Of the database.
 * @param {IDBTransactionMode} mode
 * @param {(store: IDBObjectStore) => IDBRequest<T>} act
 * @param {string} [store] Its name.
 * @returns {Promise<T>}
 */
async function within(name, mode, act, store = STORE) {
  const open = await database(name);
  try {
    return await new Promise((resolve, reject) => {
      const transaction = open.transaction(store, mode);
      const request = act(transaction.objectStore(store));
      transaction.oncomplete = () => resolve(request.result);
      transaction.onabort = () => reject(transaction.error);
    });
  } finally {
    open.close();
  }
}

/** Files of which copies are kept, and how large they may be together. */
const MOST_FILES = 6;
const MOST_BYTES = 96e6;

/** Kept as a blob: a list of them is read without what they hold. @typedef {{ name: string, time: number, file: Blob }} KeptFile */

/** Files that were opened last, the newest first; without room or leave to store there are none. */
export const recentFiles = {
  /** @returns {Promise<KeptFile[]>} */
  async all() {
    try {
      /** @type {KeptFile[]} */
      const found = await within(DATABASE, 'readonly', (store) => store.getAll(), FILES);
      return found.sort((a, b) => b.time - a.time);
    } catch {
      return [];
    }
  },

  /** @param {string} name @param {Uint8Array} bytes */
  async keep(name, bytes) {
    try {
      const file = new Blob([/** @type {BlobPart} */ (bytes)]);
      await within(DATABASE, 'readwrite', (store) => store.put({ name, time: Date.now(), file }), FILES);
      let together = 0;
      for (const [k, kept] of (await this.all()).entries()) {
        together += kept.file.size;
        if (k > 0 && (k >= MOST_FILES || together > MOST_BYTES)) await this.forget(kept.name);
      }
    } catch {
      // The file is open all the same.
    }
  },

  /** @param {string} name */
  async forget(name) {
    await within(DATABASE, 'readwrite', (store) => store.delete(name), FILES).catch(() => {});
  },
};

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
