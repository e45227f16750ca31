/** The texts of machines: nothing in one language that the other lacks, and the same places to fill. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import en from '../../www/machine/machine-en.js';
import zh from '../../www/machine/machine-zh.js';

test('Chinese has every text of machines that English has, with the same places', () => {
  assert.deepEqual(Object.keys(zh).sort(), Object.keys(en).sort());
  const places = (text) => [...text.matchAll(/\{\w+\}/g)].map(String).sort();
  for (const [id, text] of Object.entries(zh)) assert.deepEqual(places(text), places(en[id]), id);
});
