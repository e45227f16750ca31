/**
 * The program in numbers: time, and the proof that its text is the path.
 *
 * @import { State, Kept } from './types.js'
 */
import { count, feed, length, micron, minutes, plain } from '../format.js';
import { h, icon } from '../view/dom.js';
import { t } from './text.js';

/** A change of excess and gouge that is none, mm. */
const UNCHANGED = 1e-4;

/** @param {HTMLElement} root */
export function createFigures(root) {
  /** @type {unknown[]} */
  let shown = [];

  return {
    /** @param {State} state */
    update({ work, kept, job }) {
      root.hidden = !work;
      const isProving = job?.op === 'prove';
      if (!work || (shown[0] === work && shown[1] === kept && shown[2] === isProving)) return;
      shown = [work, kept, isProving];
      const { seconds, deviation, blocks, tool_length_mm: tool, cutting } = work.report;
      const time = (/** @type {number} */ s) => minutes(s / 60);
      const rows = [
        row(
          'time',
          time(seconds.total),
          t('result.time.parts', {
            cut: time(seconds.cut),
            link: time(seconds.link),
            rapid: time(seconds.rapid),
          }),
        ),
        row('blocks', count(blocks)),
        row('tool', length(tool)),
        row('back', micron(deviation.tip_mm)),
        row('axis', `${deviation.axis_deg.toFixed(5)}°`),
      ];
      if (kept) {
        const pair = (/** @type {'largest_excess_mm' | 'largest_gouge_mm'} */ key) =>
          t('result.kept', { planned: told(kept.planned[key]), posted: told(kept.posted[key]) });
        rows.push(row('excess', pair('largest_excess_mm')), row('gouge', pair('largest_gouge_mm')));
        rows.push(
          row(
            'change',
            told(kept.largest_change_mm),
            t('result.allowed', { allowed: micron(kept.allowed_mm) }),
          ),
        );
      }
      if (cutting) {
        const [least, most] = cutting.speeds_m_per_min.map((x) => plain(Math.round(x)));
        rows.push(row('spindle', `${count(cutting.rpm)} rpm`));
        if (cutting.feed_mm_per_min !== null) rows.push(row('feed', feed(cutting.feed_mm_per_min)));
        rows.push(row('speed', t('result.speed.span', { least, most })));
        rows.push(
          row(
            'least',
            t('result.least.is', {
              speed: plain(Math.round(cutting.least_speed_m_per_min)),
              diameter: length(cutting.least_diameter_mm),
            }),
          ),
        );
      }
      root.replaceChildren(verdict(kept, isProving), h('dl', { class: 'machine-figures' }, ...rows));
    },
  };
}

/** @param {number | null} mm Nothing that is cut has no excess. */
function told(mm) {
  return mm === null ? '–' : Math.abs(mm) < 5e-6 ? '0.00 µm' : micron(mm);
}

/** @param {string} id @param {string} value @param {string} [more] */
function row(id, value, more) {
  const dd = h('dd', {}, value, more ? h('small', {}, more) : null);
  return h('div', { 'data-machine-figure': id }, h('dt', {}, t(`result.${id}`)), dd);
}

/** @param {Kept | null} kept @param {boolean} isProving */
function verdict(kept, isProving) {
  if (isProving) return h('p', { class: 'machine-verdict' }, t('result.proving'));
  const change = kept?.largest_change_mm ?? 0;
  const isGood = !kept || change <= kept.allowed_mm;
  const good = change <= UNCHANGED ? 'result.good' : 'result.within';
  const words = !kept ? 'result.back.good' : isGood ? good : 'result.bad';
  const name = isGood ? 'good' : 'bad';
  return h('p', { class: `machine-verdict ${name}` }, icon(name), t(words));
}
