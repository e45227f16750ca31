/** The tables of texts: nothing in one language that the other lacks, and the same places to fill. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import learnEn from '../../www/learn/texts/en.js';
import learnZh from '../../www/learn/texts/zh.js';
import en from '../../www/text/en.js';
import turning from '../../www/text/turning.js';
import turningZh from '../../www/text/turning-zh.js';
import zh from '../../www/text/zh.js';

/** Symbols, and names that the fields have anyway. */
const COMMON = [
  'unit.mm',
  'unit.cm',
  'unit.m',
  'choice.u',
  'choice.v',
  'results.q95',
  'results.q99',
  'save.size',
];

/** Page, its English, its Chinese. */
const TABLES = [
  ['milling', en, zh],
  ['turning', turning, turningZh],
];

for (const [page, english, chinese] of TABLES) {
  test(`${page}: Chinese has every text that English has`, () => {
    const missing = Object.keys(english).filter((id) => !(id in chinese) && !COMMON.includes(id));
    assert.deepEqual(missing, []);
    // Where English is the planner's own word, only Chinese needs a text.
    const needless = Object.keys(chinese).filter(
      (id) => !(id in english) && !/^(field|choice|unit)\./.test(id),
    );
    assert.deepEqual(needless, []);
  });

  test(`${page}: and the same places in each`, () => {
    const places = (text) => [...(text ?? '').matchAll(/\{\w+\}/g)].map(String).sort();
    for (const [id, text] of Object.entries(chinese)) assert.deepEqual(places(text), places(english[id]), id);
  });
}

test('the lessons are the same in both languages: their texts, formulas, figures and numbers of equations', () => {
  const [first, second] = [learnEn, learnZh];
  assert.deepEqual(Object.keys(second.table).sort(), Object.keys(first.table).sort());
  const places = (text) => [...text.matchAll(/\{\w+\}/g)].map(String).sort();
  for (const [id, text] of Object.entries(second.table)) {
    // What a text tells, it may tell in fewer words.
    for (const place of places(text)) assert.ok(places(first.table[id]).includes(place), `${id} ${place}`);
  }
  const fixed = ({ id, blocks }) => [id, ...blocks.map(([kind, text]) => (kind === 'math' ? text : kind))];
  assert.deepEqual(second.lessons.map(fixed), first.lessons.map(fixed));
});
