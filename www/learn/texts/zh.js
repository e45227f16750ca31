/** The lessons in Chinese. */
export default {
  table: {
    title: '铣刀怎样精加工一张曲面',
    intro:
      '七节短课，写给懂微积分而从未见过 CAM 系统的人。每幅图都在你阅读时由生成程序的同一规划器算出：拖动滑块试试。每节课都能在规划器中打开它的例子。',
    contents: '课程',
    planner: '铣削',
    open: '在规划器中打开此例 →',
    table: '数据表',
    waiting: '正在计算',
    failed: '此图无法算出（{message}）。',
    sources:
      '方括号中的编号是下列文献中的公式号：[1] 刘航、刘美玉，环形刀高速铣削雕塑曲面的刀具路径规划，建模与仿真，2013，2，27–30。[2] 环形刀多轴加工等残留高度步距优化一文。[3] 环曲面镜片 X、Z、C 车削一文。印刷公式有误之处，这里给出正确的并加以说明。',
    'axis.side': '侧向距离，mm',
    'axis.height': '高度，mm',

    'tilt.lead': '前倾角 λ',
    'tilt.center': '中心圆半径 R₁',
    'tilt.corner': '圆角半径 r',
    'tilt.exact': '运动刀具的轮廓',
    'tilt.circle': '有效半径的圆',
    'tilt.alt': '前倾 {lead}° 时垂直于进给的截面。半径 {radius} mm 的圆在接触点与轮廓相切，向两侧逐渐分开。',
    'tilt.caption':
      '前倾 {lead}° 时，圆角仅 {corner} mm 的刀具在接触点处像半径 {radius} mm 的球。向两侧圆便离开轮廓：它只在一点正确。',

    'strip.height': '公差 h',
    'strip.lead': '前倾角 λ',
    'strip.yaw': '偏转角 ω',
    'strip.across': '横向曲率',
    'strip.torsion': '挠率',
    'strip.over': '高出曲面，µm',
    'strip.envelope': '运动刀具的包络',
    'strip.alt':
      '包络在接触点与曲面相切，向两侧升起，在左 {left} mm、右 {right} mm 处离开 {height} µm 的公差带。',
    'strip.caption':
      '在 {height} µm 的带内曲面已加工好：行宽 {width} mm（左 {left}，右 {right}）。只用二阶近似得 {second} mm。可上下拖动公差带。',
    'strip.gouges': '此处刀具在接触点旁低于曲面：过切。加大前倾角，或减小曲率，刀具才放得下。',

    'stepover.tilt': '倾角 λ',
    'stepover.radius': '横向半径（0 为平面）',
    'stepover.height': '残留高度 h',
    'stepover.tilt.axis': '倾角，°',
    'stepover.axis': '步距，mm',
    'stepover.exact': '前倾，精确',
    'stepover.circle': '前倾，圆模型',
    'stepover.lateral': '侧倾，精确',
    'stepover.alt':
      '{tilt}° 时两刀可相距 {exact} mm，圆模型给出 {circle} mm。模拟切削后留下 {exactLeft} 与 {circleLeft} µm，要求为 {height} µm。',
    'stepover.caption':
      '{tilt}°：精确 {exact} mm，圆模型 {circle} mm。刚刚模拟切削了这样两刀：分别留下 {exactLeft} µm 与 {circleLeft} µm；要求 {height} µm。拖动可改变倾角。',
    'stepover.gouges': '{tilt}° 时刀具比凹面更平，会过切。请加大倾角。',

    'schur.lead': '前倾角 λ',
    'schur.torsion': '曲面挠率',
    'schur.across': '横向曲率',
    'schur.yaw': '偏转角 ω，°',
    'schur.width': '行宽，mm',
    'schur.exact': '运动刀具，精确',
    'schur.schur': '舒尔补',
    'schur.section': '法截面 K_bb',
    'schur.alt':
      '行宽随偏转角的变化。舒尔补与运动刀具相差不超过 {schur} %；法截面最多差 {section} %，在偏转 {yaw}° 处。',
    'schur.caption': '法截面最多差 {section} %（ω = {yaw}°），舒尔补不超过 {schur} %。',

    'restarts.shown': '显示的路径',
    'restarts.threshold': 'e 的阈值',
    'restarts.family': '起始',
    'restarts.kind': '路径',
    'restarts.initial': '初始',
    'restarts.neighbour': '相邻',
    'restarts.length': '长度，mm',
    'restarts.average': '平均行宽，mm',
    'restarts.efficiency': 'e',
    'restarts.alt':
      '参数域 u、v，短线沿最宽行距方向，其上有 {families} 族共 {paths} 条路径；每族与其初始路径同色。',
    'restarts.caption':
      '{families} 条初始路径（粗）及其相邻路径：共 {paths} 条，{length} mm，e 不低于 {threshold}；接缝处剩下 {left} % 的曲面。把第一个滑块从 0 拖到 100 %，可看到 [1] 图 5 如何形成。',

    'families.u': '沿 u',
    'families.v': '沿 v',
    'families.flow': '沿最宽行距',
    'families.passes': '布置方法',
    'families.length': '长度，mm',
    'families.share': '对下界',
    'families.count': '刀轨数',
    'families.time': '时间，分',
    'families.excess': '最大残留，µm',
    'families.alt': '两种刀路的俯视图：沿 {along} 的刀轨长 {iso} mm，沿最宽行距的刀轨长 {flow} mm。',
    'families.caption':
      '下界为 {floor} mm。较好的参数（{along}）需要 {iso} mm，势场 {flow} mm：少 {less} %，最好者比下界高 {above} %。全部经过模拟切削。',

    'turning.step': '每转步距',
    'turning.angle': '点间角度',
    'turning.spiral.angle': '螺旋，等角',
    'turning.spiral.arc': '螺旋，等弧长',
    'turning.circles.angle': '同心圆，等角',
    'turning.circles.arc': '同心圆，等弧长',
    'turning.head.path': '路径',
    'turning.head.points': '点数',
    'turning.head.time': '时间，s',
    'turning.head.over': '最大残留，µm',
    'turning.head.under': '最大过切，µm',
    'turning.head.acceleration': 'C 轴，°/s²',
    'turning.alt': '镜片上残余的四幅图，蓝为过切，棕为残留 20 µm。最大 {most} µm，属于{name}。',
    'turning.caption':
      '步距 {step} mm、{angle}°：“{name}”残留最多，{most} µm。蓝色处切得过深：沿转动方向为凹时，直线段会切入。',
  },

  lessons: [
    {
      id: 'tilt',
      title: '倾斜的刀具是更圆的刀具',
      blocks: [
        [
          'p',
          '环形刀是半径 R₁ 的圆盘加上圆边：圆角半径为 r。若竖直立在平面上，它的整个底面都会拖过零件。所以让它向前倾几度，即前倾角 λ，只有边缘上一点接触：刀触点。',
        ],
        [
          'p',
          '从后面沿进给方向看，刀具是什么样子？边缘是圆，斜看的圆是椭圆，半轴为 R₁ 与 R₁ sin λ。椭圆最平处的曲率半径为 R₁² / (R₁ sin λ)，圆角再在周围加上自己的半径：',
        ],
        ['math', 'R_e = \\frac{R_1}{sin \\lambda} + r', '[2] (1)'],
        [
          'p',
          '这就是五轴铣削的理由：10 mm 的刀具几乎不倾斜时像上百毫米的球，倾得多一些便收紧到曲面所需。在凹面上倾得太少，它比凹面更平，就会过切。',
        ],
        ['figure'],
        [
          'p',
          '公式在接触点处精确，对二阶导数以外什么也没说。图中曲线是运动圆环的包络；拖动前倾角，看它们多快分开。',
        ],
      ],
    },
    {
      id: 'strip',
      title: '一刀加工多宽：从 P_a 到 P_b',
      blocks: [
        [
          'p',
          '刀具运动时留下一道沟：它所有位置的包络。设 C(θ) 为圆边的中心圆，T 为其切线，V 为该点的速度，则包络离此圆的距离为圆角半径，方向与两者垂直：',
        ],
        ['math', 'E(\\theta) = C \\pm r \\frac{T × V}{|T × V|}'],
        [
          'p',
          '沟底高出曲面不超过公差 h 之处（沿曲面法线 n 量，而非沿 z），曲面便算加工好。两端为 P_a 与 P_b，其间为加工行：',
        ],
        ['math', '(E(P_a) - S(P_a)) \\cdot n = (E(P_b) - S(P_b)) \\cdot n = h', '[1] (8)'],
        ['math', 'w = |P_a P_b|', '[1] (9)'],
        ['figure'],
        [
          'p',
          '改变偏转角 ω：刀具向进给的一侧倾斜，左右不再等宽。所以规划时必须知道两个半宽。一刀的左端是下一刀的右端时，两刀正好边靠边。',
        ],
      ],
    },
    {
      id: 'stepover',
      title: '步距与倾角：模型、真值与试切',
      blocks: [
        [
          'p',
          '并排的两刀之间留下一道尖脊，即残留。要它不超过 h，两刀可相距多远？把轮廓当作第 1 课的圆，便是中学几何。平面上：',
        ],
        ['math', 's = 2 \\sqrt{2 R_e h - h^2}', '[2] (2)–(4)'],
        ['p', '在半径 R_a 的截面上（上号凹，下号凸），由余弦定理：'],
        ['math', 's = 2 R_a sin \\frac{\\theta_1 + \\theta_2}{2}', '[2] (8)'],
        [
          'math',
          'cos \\theta_i = \\frac{(R_a \\mp R_e)^2 + (R_a \\mp h)^2 - R_e^2}{2 (R_a \\mp R_e)(R_a \\mp h)}',
          '[2] (9)–(13)',
        ],
        ['figure'],
        [
          'p',
          '真实轮廓的两侧比圆升得更快，所以模型许诺过多，倾得越少越甚：λ 趋于 0 时它许诺无穷大。照它规划，残留就会过高。图中把两者都切一遍，告诉你高多少。',
        ],
        [
          'note',
          '对侧倾，[2] (5)–(7) 在应为圆角半径 r 处印成 R_e，并且侧面与底面共用了一个含 h 的项，而两者应各有一项。这里的曲线按改正后的轮廓计算，它由圆弧与直线组成，因而是精确的。',
        ],
      ],
    },
    {
      id: 'schur',
      title: '为什么用舒尔补而不用截面',
      blocks: [
        ['p', '在二阶近似下两个物体都是二次型。在接触点，圆环沿倾斜方向的曲率为 1/r，横向较小：'],
        ['math', 'k_{max} = \\frac{1}{r},  k_{min} = \\frac{sin \\lambda}{R_1 + r sin \\lambda}', '[1] (3)'],
        [
          'p',
          '按偏转角转到进给 f 与侧向 b 的标架，再减去曲面，剩下对称矩阵 K：间隙张开的快慢。K 没有负方向时刀具放得下。人们容易直接横切一刀，由 K_bb 读出行宽：',
        ],
        ['math', 'w_{section} = 2 \\sqrt{\\frac{2 h}{K_{bb}}}'],
        [
          'p',
          '但刀具在运动。侧面的一点并非在刀具与它并排时加工好，而是稍早或稍晚，在间隙最小之时。所以要沿进给取最小：y 固定时，K_ff x² + 2 K_fb x y + K_bb y² 对 x 的最小值是 y² 乘以 K 中 K_ff 的舒尔补。',
        ],
        [
          'math',
          '\\kappa_\\perp = K_{bb} - \\frac{K_{fb}^2}{K_{ff}} = \\frac{det K}{K_{ff}},  w \\approx 2 \\sqrt{\\frac{2 h}{\\kappa_\\perp}}',
        ],
        ['figure'],
        [
          'p',
          '只有 K_fb 为零时两者一致：偏转为零且曲面无挠率。扭曲叶片上两者都不成立，而且偏转的正负有别：一边行宽变大，另一边变小。[1] (7) 用的是截面，并忽略挠率。',
        ],
      ],
    },
    {
      id: 'restarts',
      title: '势场、初始路径与重新开始',
      blocks: [
        [
          'p',
          '现在让进给方向也自由。在每一点，对所有不过切的姿态，总有一个方向行宽最大：称此宽度为加工势 w_max。图中短线表示两者。沿步长为 d_j 的路径，平均行宽与切削效率为',
        ],
        ['math', 'w_{avg} = \\frac{\\sum d_j w_j}{\\sum d_j}', '[1] (10)'],
        ['math', 'e = \\frac{\\sum d_j w_j}{\\sum d_j w_{max,j}}', '[1] (11)'],
        [
          'p',
          '[1] 的方法：从许多点沿短线走，取 w_avg 最大的路径（12）为初始路径。相邻路径与它边靠边。它们逐渐偏离最优方向，e 随之下降；低于阈值便停下，在剩下的区域重新开始。',
        ],
        ['figure'],
        [
          'p',
          '论文没有说的两件事：只求平均行宽最大，会偏爱好地段里的短段，所以候选路径要有最短长度；每次重新开始都在两族相接处留下接缝，降低阈值则接缝少而行宽窄。',
        ],
      ],
    },
    {
      id: 'families',
      title: '参数线与势场，以及两者的下界',
      blocks: [
        ['p', '任何刀路能好到什么程度？每走一毫米最多加工 w_max 平方毫米。所以无论怎样走，长度总不低于'],
        ['math', 'L \\ge \\int \\frac{dA}{w_{max}(p)}'],
        [
          'p',
          '沿函数 φ 等值线的刀轨总长为 ∬ |∇φ| dA（余面积公式）；若 φ 每刀增加一，则处处要有 |∇φ| 不小于 1/w。参数线把方向定死，一刀上最窄处决定下一刀能离多远。势场选取 φ，使等值线走在行宽大的方向上，并且沿线行宽变化小。',
        ],
        ['figure'],
        [
          'p',
          '论文 [1] 的例子：39 条共 2212.5 mm，参数线 35 条共 3678.6 mm，少 39.9 %。曲面没有给出，无人能重做；这里可以，用这张鞍面，或用你自己的曲面：规划器中的“比较所有方法”做的正是这件事。',
        ],
      ],
    },
    {
      id: 'turning',
      title: '车床上的镜片：螺旋、等角、等弧长',
      blocks: [
        [
          'p',
          '同样的想法用在另一种机床上。环曲面镜片不是回转体，所以主轴要作为一个轴来转：C 转动时 X 向内进给，Z 每转进退两次。基弧半径 a、回转半径 R 的曲面为',
        ],
        [
          'math',
          'z(\\rho, \\theta) = -(R + a) + \\sqrt{(R + \\sqrt{a^2 - \\rho^2 sin^2 \\theta})^2 - \\rho^2 cos^2 \\theta}',
        ],
        [
          'p',
          '半径 r_d 的球形刀头，球心在等距面上：a 换成 a + r_d，前面的常数除外。（对圆弧刀片这不对：它只在 X、Z 平面内切削。）',
        ],
        [
          'math',
          'z_c(\\rho, \\theta) = -(R + a) + \\sqrt{(R + \\sqrt{(a + r_d)^2 - \\rho^2 sin^2 \\theta})^2 - \\rho^2 cos^2 \\theta}',
          '[3] (8)、(9)',
        ],
        ['p', '两点之间机床在 X、Z、C 上走直线，多留或多切约'],
        ['math', '\\Delta z \\approx \\frac{z_{\\theta\\theta} \\Delta\\theta^2}{8}'],
        ['figure'],
        [
          'p',
          '等角使 C 匀速，边缘弧长最大、残留最多。等弧长使点在镜片上均匀，但靠近轴心时 C 要加速。螺旋从不抬刀；同心圆之间要换圈。车削页面在机床坐标中验证程序。',
        ],
      ],
    },
  ],
};
