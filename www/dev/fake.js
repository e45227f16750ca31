// Dev only: a planner that plans nothing.
const wait = (ms) => {
  const end = performance.now() + ms;
  while (performance.now() < end);
};
export default async function init() {}
const num = (name, unit, min, max, step, def) => ({
  name,
  type: 'number',
  unit,
  min,
  max,
  step,
  default: def,
});
const S = {
  version: 1,
  groups: [
    {
      id: 'cutter',
      path: 'cutter',
      variants: [
        {
          kind: 'bull_nose',
          fields: [
            num('diameter_mm', 'mm', 0.1, 200, 0.5, 12),
            num('corner_radius_mm', 'mm', 0, 100, 0.5, 3),
            num('height_mm', 'mm', 1, 300, 1, 30),
          ],
        },
        {
          kind: 'ball',
          fields: [num('diameter_mm', 'mm', 0.1, 200, 0.5, 12), num('height_mm', 'mm', 1, 300, 1, 30)],
        },
        {
          kind: 'tapered',
          fields: [
            num('diameter_mm', 'mm', 0.1, 200, 0.5, 12),
            num('corner_radius_mm', 'mm', 0, 100, 0.5, 1),
            num('taper_deg', 'deg', -30, 60, 0.5, 5),
            num('height_mm', 'mm', 1, 300, 1, 30),
          ],
        },
      ],
    },
    {
      id: 'strategy',
      path: 'strategy',
      variants: [
        {
          kind: 'iso_parametric',
          for: ['surface'],
          fields: [
            { name: 'direction', type: 'choice', options: ['auto', 'u', 'v'], default: 'auto' },
            num('lead_deg', 'deg', 0, 60, 1, 5),
          ],
        },
        { kind: 'iso_planar', for: ['surface'], fields: [num('angle_deg', 'deg', -180, 180, 5, 0)] },
        { kind: 'raster', for: ['mesh'], fields: [num('angle_deg', 'deg', -180, 180, 5, 0)] },
      ],
    },
    {
      id: 'tolerance',
      path: 'tolerance',
      fields: [
        num('scallop_mm', 'mm', 0.0001, 5, 0.001, 0.01),
        num('chord_mm', 'mm', 0.0001, 1, 0.001, 0.002),
      ],
    },
    {
      id: 'links',
      path: 'links',
      fields: [num('clearance_mm', 'mm', 0, 500, 1, 10), { name: 'zigzag', type: 'boolean', default: true }],
    },
    {
      id: 'feeds',
      path: 'feeds',
      fields: [
        num('cut_mm_per_min', 'mm/min', 1, 50000, 50, 1500),
        num('rapid_mm_min', 'mm/min', 1, 100000, 100, 10000),
      ],
    },
    {
      id: 'verify',
      path: 'verify',
      fields: [{ name: 'on', type: 'boolean', default: true }, num('spacing_mm', 'mm', 0.01, 10, 0.05, 0.25)],
    },
  ],
};
const spec = (name, source) => ({
  version: 1,
  name,
  source: { side: 'front', ...source },
  cutter: { kind: 'bull_nose', diameter_mm: 12, corner_radius_mm: 3, height_mm: 30 },
  strategy: { kind: 'iso_parametric', direction: 'auto', lead_deg: 5 },
  tolerance: { scallop_mm: 0.01, chord_mm: 0.002 },
  links: { clearance_mm: 10, zigzag: true },
  feeds: { cut_mm_per_min: 1500, rapid_mm_min: 10000 },
  verify: { on: true, spacing_mm: 0.25 },
});
export const schema = () => JSON.stringify(S);
export const gallery = () =>
  JSON.stringify(['wave', 'blade', 'dome'].map((id) => ({ id, spec: spec(id, { kind: id }) })));
export function inspect(name, bytes) {
  wait(200);
  if (bytes.length < 100) throw JSON.stringify({ code: 'import', message: `${name}: no facets found` });
  const mesh = !/igs|iges|csv/i.test(name);
  const face = (index) => ({
    index,
    name: `face ${index + 1}`,
    kind: mesh ? 'mesh' : 'surface',
    detail: '',
    bounds_mm: [
      [-50, -50, -8],
      [50, 50, 8],
    ],
  });
  return JSON.stringify({
    format: mesh ? 'STL' : 'IGES',
    unit: /iges/.test(name) ? 'inch' : null,
    warnings: ['3 entities of type 126 were passed over'],
    faces: mesh ? [face(0)] : [face(0), face(1)],
  });
}
const Z = {
  wave: (x, y) => 8 * Math.sin(x / 16) * Math.cos(y / 18),
  blade: (x, y) => (x * y) / 180 + (y * y) / 300,
  dome: (x, y) => Math.sqrt(140 * 140 - x * x - y * y) - 120,
  file: (x, y) => 10 * Math.exp(-(x * x + y * y) / 900),
};
class Picture {
  constructor(s) {
    const z = Z[s.source.kind];
    const N = 140;
    const p = [],
      n = [],
      idx = [];
    const sg = s.source.side === 'back' ? -1 : 1;
    for (let j = 0; j <= N; j++)
      for (let i = 0; i <= N; i++) {
        const x = (i / N - 0.5) * 100,
          y = (j / N - 0.5) * (s.source.kind === 'blade' ? 60 : 100);
        const e = 1e-3;
        const gx = (z(x + e, y) - z(x - e, y)) / 2 / e,
          gy = (z(x, y + e) - z(x, y - e)) / 2 / e,
          l = Math.hypot(gx, gy, 1);
        p.push(x, y, z(x, y));
        n.push((-gx / l) * sg, (-gy / l) * sg, sg / l);
        if (i < N && j < N) {
          const a = j * (N + 1) + i;
          idx.push(a, a + 1, a + N + 2, a, a + N + 2, a + N + 1);
        }
      }
    this.p = new Float32Array(p);
    this.n = new Float32Array(n);
    this.i = new Uint32Array(idx);
    this.s = s;
  }
  positions() {
    return this.p.slice();
  }
  normals() {
    return this.n.slice();
  }
  indices() {
    return this.i.slice();
  }
  free() {}
}
export const preview = (s) => new Picture(JSON.parse(s));
class Outcome extends Picture {
  build() {
    const s = this.s,
      z = Z[s.source.kind];
    const path = [],
      cc = [];
    let L = 0,
      last = null;
    const W = s.source.kind === 'blade' ? 30 : 50;
    const passes = 46;
    const push = (x, y, zz, k) => {
      const q = [x, y, zz];
      if (last) L += Math.hypot(q[0] - last[0], q[1] - last[1], q[2] - last[2]);
      last = q;
      path.push(x, y, zz, 0, -0.09, 0.996, k, L);
      cc.push(x, y, zz);
    };
    for (let r = 0; r < passes; r++) {
      const y = -W + (2 * W * r) / (passes - 1);
      const jump = r === 20;
      for (let k = 0; k <= 200; k++) {
        const x = (r % 2 ? -1 : 1) * (k / 200 - 0.5) * 100;
        if (k === 0 && jump) {
          push(last[0], last[1], 40, 2);
          push(x, y, 40, 2);
        }
        push(x, y, z(x, y), k === 0 ? (jump ? 1 : 1) : 0);
      }
    }
    this.L = L;
    this.pa = new Float32Array(path);
    this.cc = new Float32Array(cc);
    const ex = new Float32Array(this.p.length / 3);
    for (let i = 0; i < ex.length; i++) {
      const y = this.p[3 * i + 1];
      const f = (((y + W) / (2 * W)) * 45) % 1;
      ex[i] =
        s.tolerance.scallop_mm *
        (4 * (f - 0.5) ** 2 * 0.98 - 0.04 - 0.3 * Math.max(0, Math.sin(this.p[3 * i] / 9 + y / 14) - 0.8));
      if (Math.abs(this.p[3 * i]) > 49.5) ex[i] = NaN;
    }
    this.ex = ex;
    return this;
  }
  report() {
    const s = this.s;
    return JSON.stringify({
      version: 1,
      name: s.name,
      strategy: s.strategy.kind,
      length: { cut_mm: this.L * 0.93, link_mm: this.L * 0.05, rapid_mm: 183.2 },
      passes: 46,
      points: this.pa.length / 8,
      time_min: 6.4,
      area_mm2: 10873,
      unreachable: { area_mm2: s.source.kind === 'wave' ? 12.3 : 0, cell_mm: 0.8 },
      verified: {
        largest_excess_mm: 0.0098,
        largest_excess_at: [0, 0, 0],
        largest_gouge_mm: 0.0006,
        largest_gouge_at: [0, 0, 0],
        sampling_error_mm: 0.0003,
        median_mm: 0.0031,
        q95_mm: 0.0088,
        q99_mm: 0.0094,
        share_within: 1,
        samples: 160801,
        excluded_area_mm2: 40,
      },
      scallop_mm: s.tolerance.scallop_mm,
      warnings: [],
    });
  }
  path() {
    return this.pa.slice();
  }
  contacts() {
    return this.cc.slice();
  }
  excess() {
    return this.ex.slice();
  }
  zones() {
    const a = [];
    if (this.s.source.kind === 'wave')
      for (let i = 0; i < 20; i++) a.push(20 + (i % 5) * 0.8, 0 + Math.floor(i / 5) * 0.8, -1);
    return new Float32Array(a);
  }
  apt() {
    return 'GOTO/X\n'.repeat(20000);
  }
  nc() {
    return 'G1 X0\n'.repeat(20000);
  }
  csv() {
    return 'x,y,z\n'.repeat(10000);
  }
}
export function plan(text, bytes, progress) {
  const s = JSON.parse(text);
  if (s.cutter.corner_radius_mm * 2 > s.cutter.diameter_mm)
    throw JSON.stringify({
      code: 'cutter',
      message: `must be at most ${s.cutter.diameter_mm / 2} mm for this diameter`,
      field: 'cutter.corner_radius_mm',
    });
  const ms = s.source.kind === 'file' ? 3000 : 300;
  for (let i = 0; i < 100; i++) {
    progress(i < 30 ? 'laying passes' : i < 50 ? 'linking' : 'cutting in simulation', i / 100);
    wait(ms / 100);
  }
  return new Outcome(s).build();
}
