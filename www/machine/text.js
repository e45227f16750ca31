/** Looks the texts of machines up. Only who asks for a machine loads them. */
import { language, prettify } from '../text/index.js';
import { lookup } from '../text/lookup.js';
import en from './machine-en.js';

/** @type {import('../text/lookup.js').Table} */
const table = language === 'zh' ? { ...en, ...(await import('./machine-zh.js')).default } : en;

export const { t, has } = lookup(table);

export { prettify };
