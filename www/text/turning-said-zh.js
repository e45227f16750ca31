/** What the turning planner says, in Chinese. */

/**
 * The planner's sentences, word for word with places, and the same in Chinese. Places may hold such sentences again.
 *
 * @type {[string, string][]}
 */
const SENTENCES = [
  ['x {x}, y {y} mm (radius {r} mm at {a}°)', 'x {x}、y {y} mm（半径 {r} mm，{a}°）'],
  [
    'the aperture goes beyond the surface at {at}: {reach}; {share} % of its size would do',
    '口径在 {at} 处超出曲面：{reach}；缩小到 {share} % 即可',
  ],
  [
    'a toric with base circle {a} mm and section {s} mm reaches to |y| = {y} mm along the base circle and |x| = {x} mm across',
    '基圆半径 {a} mm、截面半径 {s} mm 的环曲面沿基圆到 |y| = {y} mm，横向到 |x| = {x} mm',
  ],
  ['this conic reaches to {r} mm from its axis', '此二次曲面到离轴 {r} mm 为止'],
  ['this biconic reaches to |x| = {x} and |y| = {y}', '此双二次曲面到 |x| = {x}、|y| = {y} 为止'],
  ['this map reaches to |x| = {x} mm and |y| = {y} mm', '此高度图到 |x| = {x} mm、|y| = {y} mm 为止'],
  [
    'the nose of radius {r} mm does not fit the hollow of radius {h} mm at {at}: at most {most} mm would do',
    '半径 {r} mm 的刀尖放不进 {at} 处半径 {h} mm 的凹处：至多 {most} mm',
  ],
  [
    'the section is {s}° steep at {at}, but the edge reaches to {e}°: at least {least}° would do',
    '{at} 处截面倾斜 {s}°，而切削刃只到 {e}°：至少需要 {least}°',
  ],
  [
    'the surface falls by {s}° along the cut at {at}, but the flank clears {c}°: at least {least}° would do',
    '{at} 处曲面沿切削方向下降 {s}°，而后角为 {c}°：至少需要 {least}°',
  ],
  [
    'the surface rises by {s}° along the cut at {at}, which leaves a rake of {r}° where at least {l}° are asked for: a tool with {least}° would do',
    '{at} 处曲面沿切削方向上升 {s}°，前角只剩 {r}°，而要求至少 {l}°：前角 {least}° 的刀具即可',
  ],
  [
    'the nose finds no single place to touch at X {x} mm, C {c}°: the surface beyond the aperture bends more than the nose; at most {most} mm would do there',
    '刀尖在 X {x} mm、C {c}° 处没有唯一的切触点：口径以外的曲面比刀尖更弯；该处至多 {most} mm',
  ],
  [
    'the motion between points is {e} mm off at X {x} mm, C {c}° (limit {l} mm): {least}',
    'X {x} mm、C {c}° 处点间运动偏差 {e} mm（极限 {l} mm）：{least}',
  ],
  ['points at most {d}° apart would do', '点距至多 {d}°'],
  ['points at most {d} mm apart would do', '点距至多 {d} mm'],
  [
    '{what} reaches {v} at X {x} mm, C {c}° (limit {l}): at most {rpm} rpm would do',
    '{what}在 X {x} mm、C {c}° 处达到 {v}（极限 {l}）：至多 {rpm} 转/分',
  ],
  [
    'the limits allow at most {r} rpm, below the least of {least} rpm: {what} at X {x} mm, C {c}° would have to reach {n}',
    '极限只允许 {r} 转/分，低于最低的 {least} 转/分：X {x} mm、C {c}° 处{what}须达到 {n}',
  ],
  [
    'axes.{axis}.limits{unit}: are {l} to {h}, and the path goes from {a} to {b} in machine coordinates',
    '{axis} 轴行程为 {l} 至 {h}，而刀路在机床坐标中从 {a} 到 {b}',
  ],
  [
    'axes.{axis}: is missing: a lathe with a servo spindle needs X and Z and the rotary axis C, and none called {letter} is there',
    '缺少 {letter} 轴：带伺服主轴的车床须有 X、Z 和旋转轴 C',
  ],
  [
    'axes.{axis}.letter: is no axis of a lathe here: X, Z and C are driven, and no others',
    '{axis} 不是此处车床的轴：只驱动 X、Z 和 C',
  ],
  ['velocity of {axis}', ' {axis} 速度'],
  ['acceleration of {axis}', ' {axis} 加速度'],
  ['jerk of {axis}', ' {axis} 加加速度'],
  [
    'the path would have {n} points; at most {m} are planned: {hint}',
    '路径将有 {n} 个点，最多规划 {m} 个：{hint}',
  ],
  ['a larger step between turns would do', '请加大行距'],
  ['larger steps between turns or between points would do', '请加大行距或点距'],
  [
    'turns {s} mm apart leave cusps of {c} µm at {at}, above the {a} µm asked for: at most {most} mm would do',
    '行距 {s} mm 在 {at} 处残留 {c} µm，超过要求的 {a} µm：至多 {most} mm',
  ],
  [
    'with a rake of {r}° the edge is a circle only as ground for it; one that is round in its own face is up to {l} µm flatter',
    '前角 {r}° 时，只有专门修磨的切削刃才是圆弧；在前刀面内为圆弧的刀会偏平至多 {l} µm',
  ],
  ['only {c}° are left over the steepest fall', '最陡下降处后角只剩 {c}°'],
  ['a sagitta is {s} mm off', '有一个弦高偏差 {s} mm'],
  [
    '{d} decimals round by up to {r} µm, more than the {a} µm allowed between points: {enough} would do',
    '{d} 位小数舍入至多 {r} µm，超过点间允许的 {a} µm：{enough} 位即可',
  ],
  [
    '{w} runs to {v} with {d} decimals: {n} digits, where Fanuc controls take {m}: {enough} decimals would do',
    '{w} 走到 {v}，带 {d} 位小数共 {n} 位数字，而 Fanuc 系统只接受 {m} 位：{enough} 位小数即可',
  ],
  [
    'must be above {l} mm, so that the section across has a radius above 0',
    '须大于 {l} mm，使横向截面的半径大于 0',
  ],
  [
    'must be below {r} mm, the residue that the steps are chosen for',
    '须小于 {r} mm，即选取行距所依据的残留',
  ],
  ["must be at most {r} rpm, the spindle's highest speed", '至多 {r} 转/分，即主轴最高转速'],
  [
    'must be at least 0.01 mm, or at most −0.01 mm where it bends away',
    '至少 0.01 mm；向外弯时至多 −0.01 mm',
  ],
  [
    'each must be [power of x, power of y, height in mm], powers whole and at most 20',
    '每项须为 [x 的次数, y 的次数, 高度 mm]，次数为不超过 20 的整数',
  ],
  [
    'each must be [n, m, height in mm] with n at most 20, |m| at most n and n − |m| even',
    '每项须为 [n, m, 高度 mm]，n 不超过 20，|m| 不超过 n，且 n − |m| 为偶数',
  ],
  ['term {i}: {rest}', '第 {i} 项：{rest}'],
  [
    '{n} numbers in rows of {c} are no grid: at least 5 rows and 5 columns are needed',
    '{n} 个数、每行 {c} 个，不成网格：至少需要 5 行 5 列',
  ],
  ['line {l}: `{w}` is no number', '第 {l} 行：“{w}”不是数'],
  ['line {l}: {n} numbers, but the first row has {c}', '第 {l} 行有 {n} 个数，而第一行有 {c} 个'],
];

const PATTERNS = SENTENCES.map(([english, chinese]) => {
  /** @type {string[]} */
  const names = [];
  const pattern = english
    .split(/(\{\w+\})/)
    .map((part) => {
      const name = part.match(/^\{(\w+)\}$/)?.[1];
      if (name) names.push(name);
      return name ? '(.+?)' : part.replace(/[.*+?^${}()|[\]\\]/g, '\\$&');
    })
    .join('');
  return { pattern: new RegExp(`^${pattern}$`, 's'), names, chinese };
});

/**
 * What the planner says, in Chinese; as it is where it has no Chinese yet.
 *
 * @param {string} message
 * @returns {string}
 */
export function said(message) {
  for (const { pattern, names, chinese } of PATTERNS) {
    const found = message.match(pattern);
    if (found) return chinese.replace(/\{(\w+)\}/g, (_, name) => said(found[names.indexOf(name) + 1]));
  }
  return message;
}
