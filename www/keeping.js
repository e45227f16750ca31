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

/** @typedef {{ tab: string, time: number, draft: Draft }} Kept */

/** @returns {Promise<IDBDatabase>} */
function database() {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open(DATABASE, 2);
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
 * @param {IDBTransactionMode} mode
 * @param {(store: IDBObjectStore) => IDBRequest<T>} act
 * @param {string} [name] Of the store.
 * @returns {Promise<T>}
 */
async function within(mode, act, name = STORE) {
  const open = await database();
  try {
    return await new Promise((resolve, reject) => {
      const transaction = open.transaction(name, mode);
      const request = act(transaction.objectStore(name));
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

/** @typedef {{ name: string, time: number, bytes: Uint8Array }} KeptFile */

/** Files that were opened last, the newest first; without room or leave to store there are none. */
export const recentFiles = {
  /** @returns {Promise<KeptFile[]>} */
  async all() {
    try {
      /** @type {KeptFile[]} */
      const found = await within('readonly', (store) => store.getAll(), FILES);
      return found.sort((a, b) => b.time - a.time);
    } catch {
      return [];
    }
  },

  /** @param {string} name @param {Uint8Array} bytes */
  async keep(name, bytes) {
    try {
      await within('readwrite', (store) => store.put({ name, time: Date.now(), bytes }), FILES);
      let together = 0;
      for (const [k, file] of (await this.all()).entries()) {
        together += file.bytes.length;
        if (k > 0 && (k >= MOST_FILES || together > MOST_BYTES)) await this.forget(file.name);
      }
    } catch {
      // The file is open all the same.
    }
  },

  /** @param {string} name */
  async forget(name) {
    await within('readwrite', (store) => store.delete(name), FILES).catch(() => {});
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
