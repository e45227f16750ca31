/**
 * What is at the place of the surface that was clicked.
 *
 * @import { State } from '../types.js'
 */
import { length, micron, plain } from '../format.js';
import { t } from '../text/index.js';
import { attribute, h, icon } from './dom.js';

/** Flatter than this nobody bends a surface on purpose, 1/mm. */
const FLAT = 1e-7;

/**
 * @param {HTMLElement} root
 * @param {{ onClose: () => void }} callbacks
 */
export function createPicked(root, { onClose }) {
  const list = h('dl', {});
  const close = h('button', { type: 'button', class: 'quiet close', onclick: onClose }, icon('close'));
  attribute(close, 'aria-label', t('action.close'));
  root.append(h('h2', {}, t('picked.title')), close, list);
  root.setAttribute('aria-live', 'polite');
  /** @type {unknown} */
  let shown = null;

  return {
    /** @param {State} state */
    update({ picked }) {
      if (picked === shown) return;
      shown = picked;
      root.hidden = picked === null;
      if (!picked) return;
      const { point, u, v, least_curvature: least, most_curvature: most, excess } = picked;
      const rows = [
        ['point', point.map((x) => length(x)).join(', ')],
        !Number.isNaN(u) && ['uv', `${plain(Number(u.toPrecision(5)))}, ${plain(Number(v.toPrecision(5)))}`],
        most !== null && ['most', curvature(most)],
        least !== null && ['least', curvature(least)],
        ['excess', excess === null ? t('picked.unknown') : micron(excess)],
      ];
      list.replaceChildren(
        ...rows
          .filter((row) => row !== false)
          .map(([id, value]) =>
            h('div', { 'data-figure': id }, h('dt', {}, t(`picked.${id}`)), h('dd', {}, value)),
          ),
      );
    },
  };
}

/** A curvature with its radius and to which side. @param {number} k 1/mm, above 0 where hollow. */
function curvature(k) {
  if (Math.abs(k) < FLAT) return t('picked.flat');
  const radius = length(1 / Math.abs(k));
  return t(k > 0 ? 'picked.hollow' : 'picked.rounded', { k: plain(Number(k.toPrecision(3))), radius });
}
