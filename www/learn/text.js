/** Texts of the lessons, in the language that was chosen. */
import { language } from '../text/index.js';
import { lookup } from '../text/lookup.js';
import en from './texts/en.js';

/** @typedef {{ id: string, title: string, blocks: ([string] | [string, string] | [string, string, string])[] }} Lesson */

/** @type {{ table: Record<string, string>, lessons: Lesson[] }} */
const { table, lessons } = language === 'zh' ? (await import('./texts/zh.js')).default : en;

export { lessons };

export const { t } = lookup({ ...en.table, ...table });
