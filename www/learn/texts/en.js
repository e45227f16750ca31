/** The lessons in English: texts, formulas in the short notation of `mathml.js` with their numbers in the papers, and figures. */
export default {
  table: {
    title: 'How a mill finishes a surface',
    intro:
      'Seven short lessons for people who know calculus and have never seen a CAM system. Every figure is computed while you read, by the very planner that makes the programs: move the handles. Each lesson opens its case in the planner.',
    contents: 'Lessons',
    planner: 'Milling',
    open: 'Open this case in the planner →',
    table: 'The numbers as a table',
    waiting: 'Computing',
    failed: 'This figure could not be computed ({message}).',
    sources:
      'Numbers in brackets are the equations’ in: [1] H. Liu and M. Liu, Tool path planning for high speed milling of sculpture surface with toroidal cutter, Modeling and Simulation 2, 2013, 27–30. [2] The paper on the stepover of toroidal cutters at constant scallop height (in Chinese). [3] The paper on turning toric lenses with X, Z and C (in Chinese). Where a printed formula is wrong, the right one stands here and the text says so.',
    'axis.side': 'Distance to the side, mm',
    'axis.height': 'Height, mm',

    'tilt.lead': 'Lead λ',
    'tilt.center': 'Centre circle R₁',
    'tilt.corner': 'Corner radius r',
    'tilt.exact': 'Profile of the moving cutter',
    'tilt.circle': 'Circle of the effective radius',
    'tilt.alt':
      'Section square to the feed at a lead of {lead}°. The circle of radius {radius} mm touches the profile at the contact and rises faster than it to the sides at first, then the true profile turns up.',
    'tilt.caption':
      'At a lead of {lead}° the cutter with a corner of only {corner} mm cuts like a ball of {radius} mm radius at the contact. To the sides the circle leaves the profile: it is right at one point.',

    'strip.height': 'Tolerance h',
    'strip.lead': 'Lead λ',
    'strip.yaw': 'Yaw ω',
    'strip.across': 'Curvature across',
    'strip.torsion': 'Torsion',
    'strip.over': 'Height over the surface, µm',
    'strip.envelope': 'Envelope of the moving cutter',
    'strip.alt':
      'The envelope touches the surface at the contact, rises to both sides and leaves the band of {height} µm at {left} mm to the left and {right} mm to the right.',
    'strip.caption':
      'Inside the band of {height} µm the surface is finished: a strip of {width} mm ({left} left, {right} right). Second order alone says {second} mm. Drag the band up and down.',
    'strip.gouges':
      'Here the cutter goes below the surface beside its contact: it gouges. More lead, or less curvature, would let it stand.',

    'stepover.tilt': 'Tilt λ',
    'stepover.radius': 'Radius across (0: flat)',
    'stepover.height': 'Scallop height h',
    'stepover.tilt.axis': 'Tilt, °',
    'stepover.axis': 'Stepover, mm',
    'stepover.exact': 'Lead, exact',
    'stepover.circle': 'Lead, circle model',
    'stepover.lateral': 'Lateral tilt, exact',
    'stepover.alt':
      'At {tilt}° two passes may lie {exact} mm apart, the circle model says {circle} mm. Cut in simulation they leave {exactLeft} and {circleLeft} µm where {height} µm were asked for.',
    'stepover.caption':
      'At {tilt}°: exact {exact} mm, circle model {circle} mm. Two such passes were just cut in simulation: they leave {exactLeft} µm and {circleLeft} µm; asked for were {height} µm. Drag to change the tilt.',
    'stepover.gouges': 'At {tilt}° the cutter is flatter than the hollow and gouges. Tilt it more.',

    'schur.lead': 'Lead λ',
    'schur.torsion': 'Torsion of the surface',
    'schur.across': 'Curvature across',
    'schur.yaw': 'Yaw ω, °',
    'schur.width': 'Width of the strip, mm',
    'schur.exact': 'Moving cutter, exact',
    'schur.schur': 'Schur complement',
    'schur.section': 'Normal section K_bb',
    'schur.alt':
      'Widths by yaw. The Schur complement stays within {schur} % of the moving cutter; the normal section is off by up to {section} %, at a yaw of {yaw}°.',
    'schur.caption':
      'The normal section is off by up to {section} % (at ω = {yaw}°), the Schur complement by no more than {schur} %.',

    'restarts.shown': 'Paths shown',
    'restarts.threshold': 'Threshold of e',
    'restarts.family': 'Beginning',
    'restarts.kind': 'Path',
    'restarts.initial': 'initial',
    'restarts.neighbour': 'neighbour',
    'restarts.length': 'Length, mm',
    'restarts.average': 'Mean width, mm',
    'restarts.efficiency': 'e',
    'restarts.alt':
      'The domain of u and v with short lines along the widest strips, and {paths} paths in {families} families over it; each family has the colour of its initial path.',
    'restarts.caption':
      '{families} initial paths (thick) with their neighbours: {paths} paths, {length} mm, e never below {threshold}; {left} % of the surface are left at the seams. Draw the first handle from 0 to 100 % to see figure 5 of [1] come about.',

    'families.u': 'Along u',
    'families.v': 'Along v',
    'families.flow': 'Along the widest strips',
    'families.passes': 'Passes laid',
    'families.length': 'Length, mm',
    'families.share': 'Of the floor',
    'families.count': 'Passes',
    'families.time': 'Time, min',
    'families.excess': 'Largest excess, µm',
    'families.alt':
      'Two plans from above: passes along {along}, {iso} mm long, and passes along the widest strips, {flow} mm long.',
    'families.caption':
      'The floor is {floor} mm. The better parameter ({along}) needs {iso} mm, the field {flow} mm: {less} % less, and {above} % above the floor at best. All were cut in simulation.',

    'turning.step': 'Step between turns',
    'turning.angle': 'Angle between points',
    'turning.spiral.angle': 'Spiral, equal angles',
    'turning.spiral.arc': 'Spiral, equal arcs',
    'turning.circles.angle': 'Circles, equal angles',
    'turning.circles.arc': 'Circles, equal arcs',
    'turning.head.path': 'Path',
    'turning.head.points': 'Points',
    'turning.head.time': 'Time, s',
    'turning.head.over': 'Most left, µm',
    'turning.head.under': 'Most overcut, µm',
    'turning.head.acceleration': 'C axis, °/s²',
    'turning.alt':
      'Four maps of what is left on the lens, from blue for overcut to brown for 20 µm left. The most is {most} µm, for {name}.',
    'turning.caption':
      'Steps of {step} mm and {angle}°: most is left by “{name}”, {most} µm. Blue is cut too deep: straight moves dig in where the lens is hollow along the turn.',
  },

  lessons: [
    {
      id: 'tilt',
      title: 'A leaning cutter is a rounder cutter',
      blocks: [
        [
          'p',
          'A bull-nose mill is a disc of radius R₁ with a rounded rim: its corner has the radius r. Upright on a plane it would drag its whole bottom over the part. So it leans forward by a few degrees, the lead λ, and only a point of the rim touches: the contact.',
        ],
        [
          'p',
          'What does the cutter look like from behind, along the feed? The rim is a circle, and a circle seen aslant is an ellipse with the half axes R₁ and R₁ sin λ. Where an ellipse is flattest it is as round as a circle of radius R₁² / (R₁ sin λ). The corner adds its own radius all around:',
        ],
        ['math', 'R_e = \\frac{R_1}{sin \\lambda} + r', '[2] (1)'],
        [
          'p',
          'That is the reason to mill with five axes: a cutter of 10 mm cuts like a ball of a hundred millimetres when it hardly leans, and by leaning more it becomes as tight as the surface needs. Lean it too little over a hollow, and it is flatter than the hollow: it gouges.',
        ],
        ['figure'],
        [
          'p',
          'The formula is exact at the contact and says nothing beyond the second derivative. The curve in the figure is the envelope of the moving torus; drag the lead and see how soon they part.',
        ],
      ],
    },
    {
      id: 'strip',
      title: 'What one pass finishes: the strip from P_a to P_b',
      blocks: [
        [
          'p',
          'While the cutter moves, it leaves a groove: the envelope of all its positions. With C(θ) the circle in the middle of the rim, T its tangent and V the velocity of that point, the envelope is as far from the circle as the corner is round, square to both:',
        ],
        ['math', 'E(\\theta) = C \\pm r \\frac{T × V}{|T × V|}'],
        [
          'p',
          'Where the groove is no higher above the surface than the tolerance h (measured along the surface normal n, not along z), the surface counts as finished. The two ends are P_a and P_b, and the strip is what lies between:',
        ],
        ['math', '(E(P_a) - S(P_a)) \\cdot n = (E(P_b) - S(P_b)) \\cdot n = h', '[1] (8)'],
        ['math', 'w = |P_a P_b|', '[1] (9)'],
        ['figure'],
        [
          'p',
          'Move the yaw ω: the cutter then leans to one side of the feed, and the strip is no longer as wide to the left as to the right. So a planner has to know both halves. Neighbouring passes lie edge to edge when the left end of one is the right end of the next.',
        ],
      ],
    },
    {
      id: 'stepover',
      title: 'Stepover against tilt: the model, the truth, and a trial',
      blocks: [
        [
          'p',
          'Two equal passes side by side leave a cusp between them, the scallop. How far apart may they lie so that it stays below h? Take the profile for the circle of lesson 1, and it is school geometry. On a plane:',
        ],
        ['math', 's = 2 \\sqrt{2 R_e h - h^2}', '[2] (2)–(4)'],
        ['p', 'Over a section of radius R_a (upper sign hollow, lower sign rounded), by the law of cosines:'],
        ['math', 's = 2 R_a sin \\frac{\\theta_1 + \\theta_2}{2}', '[2] (8)'],
        [
          'math',
          'cos \\theta_i = \\frac{(R_a \\mp R_e)^2 + (R_a \\mp h)^2 - R_e^2}{2 (R_a \\mp R_e)(R_a \\mp h)}',
          '[2] (9)–(13)',
        ],
        ['figure'],
        [
          'p',
          'The circle is rounder than the ellipse on its flanks, so the model promises too much, and the more so the less the cutter leans: as λ goes to 0 it promises infinity. Whoever plans by it leaves scallops that are too high. The figure says how high, by cutting both.',
        ],
        [
          'note',
          'For lateral tilt, to the side of the feed, [2] (5)–(7) print R_e where the corner radius r belongs, and one common term for h where side and bottom need their own. The curve here is of the corrected profile, which is made of arcs and lines and therefore exact.',
        ],
      ],
    },
    {
      id: 'schur',
      title: 'Why the Schur complement and not the section',
      blocks: [
        [
          'p',
          'To second order both bodies are quadratic forms. At its contact the torus bends by 1/r along its lean and by less across it:',
        ],
        ['math', 'k_{max} = \\frac{1}{r},  k_{min} = \\frac{sin \\lambda}{R_1 + r sin \\lambda}', '[1] (3)'],
        [
          'p',
          'Turn that by the yaw into the frame of feed f and side b, and subtract the surface. What is left is a symmetric matrix K: how fast the gap opens. The cutter fits where K has no negative direction. It is tempting to cut straight across and read the width from K_bb:',
        ],
        ['math', 'w_{section} = 2 \\sqrt{\\frac{2 h}{K_{bb}}}'],
        [
          'p',
          'But the cutter moves. A point to the side is not finished when the cutter is abreast of it; it is finished a little before or after, whenever the gap is smallest. So minimise over the feed: for a fixed y, the least of K_ff x² + 2 K_fb x y + K_bb y² over x is y² times the Schur complement of K_ff in K.',
        ],
        [
          'math',
          '\\kappa_\\perp = K_{bb} - \\frac{K_{fb}^2}{K_{ff}} = \\frac{det K}{K_{ff}},  w \\approx 2 \\sqrt{\\frac{2 h}{\\kappa_\\perp}}',
        ],
        ['figure'],
        [
          'p',
          'The two agree only when K_fb is zero: yaw zero on a surface without torsion. On a twisted blade neither holds, and the sign of the yaw matters: one way the strip grows, the other way it shrinks. [1] (7) reads the section and ignores torsion.',
        ],
      ],
    },
    {
      id: 'restarts',
      title: 'The potential field, the first path, and new beginnings',
      blocks: [
        [
          'p',
          'Now let the direction of the feed be free. At every point there is one direction in which the strip is widest, over all postures that do not gouge: call that width the machining potential w_max. The short lines in the figure show both. Along a path with the steps d_j its mean width and its efficiency are',
        ],
        ['math', 'w_{avg} = \\frac{\\sum d_j w_j}{\\sum d_j}', '[1] (10)'],
        ['math', 'e = \\frac{\\sum d_j w_j}{\\sum d_j w_{max,j}}', '[1] (11)'],
        [
          'p',
          'The method of [1]: follow the lines from many places and keep the path with the largest w_avg (12): the initial path. Its neighbours lie edge to edge beside it. They drift away from the best directions, so e falls; when it is below a threshold, stop, and begin anew in what is left.',
        ],
        ['figure'],
        [
          'p',
          'Two things the paper does not say. The largest mean width alone favours short stubs in good places, so candidates need a least length. And every new beginning leaves a seam where the families meet; lower the threshold and there are fewer seams, but narrower strips.',
        ],
      ],
    },
    {
      id: 'families',
      title: 'Parameters against the field, and the floor under both',
      blocks: [
        [
          'p',
          'How good can any path be? Each millimetre of it finishes at most w_max square millimetres. So whatever the path, its length stays above',
        ],
        ['math', 'L \\ge \\int \\frac{dA}{w_{max}(p)}'],
        [
          'p',
          'Passes along level lines of a function φ are ∬ |∇φ| dA long (the co-area formula), and if φ rises by one from pass to pass, |∇φ| must be at least 1/w everywhere. Lines of a parameter fix the directions; then the narrowest place along a pass decides how far the next one may lie. The field chooses φ so that its lines run where strips are wide, and so that the width changes little along them.',
        ],
        ['figure'],
        [
          'p',
          'The published example [1] has 39 passes of 2212.5 mm against 35 of 3678.6 mm along a parameter: 39.9 % less. Its surface is not given, so nobody can repeat it; here you can, on this saddle and on your own surface: “Compare all strategies” in the planner does the same.',
        ],
      ],
    },
    {
      id: 'turning',
      title: 'A lens on a lathe: spiral, equal angle, equal arc',
      blocks: [
        [
          'p',
          'The same thoughts on another machine. A toric lens is not round, so a lathe cuts it with a spindle that is an axis: while C turns, X feeds inwards and Z swings in and out twice a turn. With base radius a and rotation radius R the surface is',
        ],
        [
          'math',
          'z(\\rho, \\theta) = -(R + a) + \\sqrt{(R + \\sqrt{a^2 - \\rho^2 sin^2 \\theta})^2 - \\rho^2 cos^2 \\theta}',
        ],
        [
          'p',
          'A ball-shaped tool of radius r_d stands with its centre on the offset surface: a becomes a + r_d, except in the constant in front. (For a round-nose insert this is wrong: it cuts in the plane of X and Z alone.)',
        ],
        [
          'math',
          'z_c(\\rho, \\theta) = -(R + a) + \\sqrt{(R + \\sqrt{(a + r_d)^2 - \\rho^2 sin^2 \\theta})^2 - \\rho^2 cos^2 \\theta}',
          '[3] (8), (9)',
        ],
        ['p', 'Between points the machine moves straight in X, Z and C, and leaves or digs out about'],
        ['math', '\\Delta z \\approx \\frac{z_{\\theta\\theta} \\Delta\\theta^2}{8}'],
        ['figure'],
        [
          'p',
          'Equal angles keep C even and leave most at the rim, where the arcs are long. Equal arcs spread points evenly over the lens but make C hurry near the axis. The spiral never lifts; circles need a step from one to the next. The turning page proves programs in machine coordinates.',
        ],
      ],
    },
  ],
};
