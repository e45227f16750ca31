/** Looks the turning page's texts up, in the language that the whole page is in. */
import { language, prettify } from '../text/index.js';
import { lookup } from '../text/lookup.js';
import en from '../text/turning.js';

/** Only who reads Chinese loads these. */
const [chinese, sentences] =
  language === 'zh'
    ? await Promise.all([import('../text/turning-zh.js'), import('../text/turning-said-zh.js')])
    : [];

export const { t, has } = lookup({ ...en, ...chinese?.default });

/** What the planner says, in the language of the page. @param {string} message */
export const said = (message) => sentences?.said(message) ?? message;

export { language, prettify };
