/** The tables of texts: nothing in one language that the other lacks, and the same places to fill. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import machineEn from '../../www/machine/machine-en.js';
import machineZh from '../../www/machine/machine-zh.js';
import en from '../../www/text/en.js';
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

const places = (text) => [...text.matchAll(/\{\w+\}/g)].map(String).sort();

for (const [what, english, chinese] of [
  ['the page', en, zh],
  ['machines', machineEn, machineZh],
]) {
  test(`Chinese has every text of ${what} that English has`, () => {
    const missing = Object.keys(english).filter((id) => !(id in chinese) && !COMMON.includes(id));
    assert.deepEqual(missing, []);
    assert.deepEqual(
      Object.keys(chinese).filter((id) => !(id in english)),
      [],
    );
  });

  test(`and the same places in each text of ${what}`, () => {
    for (const [id, text] of Object.entries(chinese)) assert.deepEqual(places(text), places(english[id]), id);
  });
}
