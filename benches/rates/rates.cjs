// The same as src/main.rs, as WebAssembly in Node; the argument is the module's folder.
const { Work } = require(`${process.argv[2]}/rates.js`);

const MEASUREMENTS = 5;
const LEAST_SECONDS = 0.2;

/** Processor seconds: of this thread where Node tells them, else with those of its compiler. */
function seconds() {
  const { user, system } = (process.threadCpuUsage ?? process.cpuUsage)();
  return (user + system) / 1e6;
}

for (let kind = 0; ; kind += 1) {
  const work = Work.prepare(kind);
  if (!work) break;
  let [best, done] = [Number.POSITIVE_INFINITY, 1];
  for (let i = 0; i < MEASUREMENTS; i += 1) {
    const start = seconds();
    let [count, spent] = [0, 0];
    while (spent < LEAST_SECONDS) {
      count += work.run();
      spent = seconds() - start;
    }
    if (spent / count < best / done) [best, done] = [spent, count];
  }
  console.log(`${best}\t${done}\t${work.name()}`);
  work.free();
}
