/**
 * Formulas, from a short notation: letters are variables, words functions, `_` and `^` scripts, `{ }` groups, and after a
 * backslash `frac`, `sqrt`, `int`, `sum` and Greek letters as in TeX.
 */

const NS = 'http://www.w3.org/1998/Math/MathML';

/** @type {Record<string, string>} */
const SIGNS = {
  lambda: 'λ',
  omega: 'ω',
  kappa: 'κ',
  theta: 'θ',
  rho: 'ρ',
  delta: 'δ',
  Delta: 'Δ',
  phi: 'φ',
  int: '∬',
  sum: '∑',
  perp: '⊥',
  approx: '≈',
  le: '≤',
  ge: '≥',
  nabla: '∇',
  pm: '±',
  mp: '∓',
  cdot: '·',
  prime: '′',
};

/** @param {string} tag @param {...(Node | string)} children */
function m(tag, ...children) {
  const element = document.createElementNS(NS, tag);
  element.append(...children);
  return element;
}

/** @param {string} text */
export function formula(text) {
  const tokens = text.match(/\\[a-zA-Z]+|[0-9]+(?:\.[0-9]+)?|[a-zA-Z]+|\S/g) ?? [];
  let at = 0;

  /** What stands between braces, or the next sign alone. @returns {Element} */
  function group() {
    if (tokens[at] !== '{') return atom();
    at += 1;
    const inside = until('}');
    at += 1;
    return inside;
  }

  /** @returns {Element} */
  function atom() {
    const token = tokens[at];
    at += 1;
    if (token === '\\frac') return m('mfrac', group(), group());
    if (token === '\\sqrt') return m('msqrt', group());
    if (token === '{') {
      at -= 1;
      return group();
    }
    if (token.startsWith('\\')) {
      const sign = SIGNS[token.slice(1)] ?? token.slice(1);
      return /\p{L}/u.test(sign) ? m('mi', sign) : m('mo', sign);
    }
    if (/^[0-9]/.test(token)) return m('mn', token);
    const sign = m(/^[a-zA-Z]/.test(token) ? 'mi' : 'mo', token === '-' ? '−' : token);
    // Nothing here is so tall that brackets must grow with it.
    if ('()|'.includes(token)) sign.setAttribute('stretchy', 'false');
    return sign;
  }

  /** @param {string} end @returns {Element} */
  function until(end) {
    const row = m('mrow');
    while (at < tokens.length && tokens[at] !== end) {
      let base = atom();
      const scripts = { _: /** @type {Element | null} */ (null), '^': /** @type {Element | null} */ (null) };
      while (tokens[at] === '_' || tokens[at] === '^') {
        const kind = /** @type {'_' | '^'} */ (tokens[at]);
        at += 1;
        scripts[kind] = group();
      }
      if (scripts._ && scripts['^']) base = m('msubsup', base, scripts._, scripts['^']);
      else if (scripts._) base = m('msub', base, scripts._);
      else if (scripts['^']) base = m('msup', base, scripts['^']);
      row.append(base);
    }
    return row;
  }

  const math = m('math', until(''));
  math.setAttribute('display', 'block');
  return math;
}
