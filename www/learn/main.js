/**
 * The lessons: texts, formulas with their numbers in the papers, figures computed as they come into sight, and links that open
 * their cases in the planner.
 */
import { keepOffline } from '../offline.js';
import { linked } from '../share/link.js';
import { createStudyPlanner } from '../study/planner.js';
import { t as page } from '../text/index.js';
import { attribute, h, place } from '../view/dom.js';
import { languageButton } from '../view/language.js';
import { compared, createFamilies } from './figures/families.js';
import { contactJob } from './figures/job.js';
import { createRestarts, monkeySaddle } from './figures/restarts.js';
import { createSchur } from './figures/schur.js';
import { createStepover } from './figures/stepover.js';
import { createStrip } from './figures/strip.js';
import { createTilt } from './figures/tilt.js';
import { createTurning } from './figures/turning.js';
import { formula } from './mathml.js';
import { lessons, t } from './text.js';

/** @typedef {(op: string, args: any[], onProgress?: (phase: string, fraction: number) => void) => Promise<any>} Ask */

/** @type {ReturnType<typeof createStudyPlanner> | null} */
let planner = null;
/** @type {Ask} */
const ask = (op, args, onProgress) => {
  planner ??= createStudyPlanner('learn');
  return planner.call(op, args, onProgress);
};

/** Figures by the lesson's id. @type {Record<string, () => { figure: HTMLElement }>} */
const FIGURES = {
  tilt: () => createTilt(ask),
  strip: () => createStrip(ask),
  stepover: () => createStepover(ask),
  schur: () => createSchur(ask),
  restarts: () => createRestarts(ask),
  families: () => createFamilies(ask),
  turning: () => createTurning(),
};

/** The jobs that links open. @type {Record<string, any>} */
const JOBS = {
  tilt: contactJob(3, 2, 0.01),
  strip: contactJob(9.5, 3, 0.01),
  stepover: contactJob(3, 2, 0.1),
  schur: { ...monkeySaddle(), strategy: { kind: 'iso_parametric', along: 'u', rule: 'widest' } },
  restarts: {
    ...monkeySaddle(),
    strategy: { kind: 'constant_scallop', start: 'v_line', rule: 'matched', least_lead_deg: 4 },
  },
  families: compared({ kind: 'flow' }),
};

/** @param {string} id */
function opener(id) {
  if (!JOBS[id]) return h('a', { class: 'open', href: './turning.html' }, t('open'));
  const link = h('a', { class: 'open', href: './index.html' }, t('open'));
  const spec = { links: {}, feeds: {}, ...JOBS[id] };
  linked({ spec, name: spec.name, outcome: null, picture: null, isPreview: false }).then(({ fragment }) => {
    link.href = `./index.html${fragment}`;
  });
  return link;
}

/** A text whose symbols have their scripts: `w_max`. @param {string} text */
function inline(text) {
  return text.split(/([\p{L}∇]+_\p{L}+)/u).map((part) => {
    const [base, script] = part.split('_');
    return script ? h('span', { class: 'symbol' }, h('i', {}, base), h('sub', {}, script)) : part;
  });
}

/** @param {string} id @param {[string] | [string, string] | [string, string, string]} block */
function block(id, [kind, text = '', number = '']) {
  if (kind === 'math') {
    return h('div', { class: 'equation' }, formula(text), number && h('span', { class: 'number' }, number));
  }
  if (kind === 'figure') return FIGURES[id]().figure;
  return h(kind === 'note' ? 'aside' : 'p', {}, ...inline(text));
}

function start() {
  document.documentElement.lang = page('locale');
  document.title = `Stepover – ${page('learn.link')}`;
  place('modes').append(
    h('a', { href: './index.html' }, t('planner')),
    h('a', { href: './learn.html', 'aria-current': 'page' }, page('learn.link')),
    h('a', { href: './turning.html' }, page('turning.link')),
  );
  place('history').append(languageButton());
  attribute(place('contents'), 'aria-label', t('contents'));
  place('contents').append(
    h('ol', {}, ...lessons.map(({ id, title }) => h('li', {}, h('a', { href: `#${id}` }, ...inline(title))))),
  );
  place('lessons').append(
    h('header', { class: 'intro' }, h('h2', {}, t('title')), h('p', {}, t('intro'))),
    ...lessons.map(({ id, title, blocks }, i) =>
      h(
        'article',
        { id },
        h('h2', {}, h('span', {}, `${i + 1}`), h('span', {}, ...inline(title))),
        ...blocks.map((part) => block(id, part)),
        opener(id),
      ),
    ),
    h('footer', {}, t('sources')),
  );
  document.documentElement.dataset.ready = '';
  // The address may name a lesson, which was not there when it was opened.
  document.getElementById(location.hash.slice(1))?.scrollIntoView();
  keepOffline();
}

start();
