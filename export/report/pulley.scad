// ---- printing: downward faces are steep unless supports are printed ----
//= one turn
slope = supports ? 0 : overhang_deg + 2.5;  // slicers reject slopes up to a degree steeper than their threshold
//= several turns
slope = supports ? 0 : overhang_deg + 4;  // slicers reject slopes up to a degree steeper than their threshold, and draw helical faces coarsely
//= both
// height of a face at that slope over a horizontal distance; 45 degrees if supports are printed
function rise(width) = width * tan(slope > 0 ? slope : 45);
// the same for a ceiling or a cone, which is flat if supports are printed
function ceiling(width) = slope > 0 ? rise(width) : 0;
// slope of two ceilings that meet in a ridge over a slit
ridge_slope = slope > 0 ? min(slope + 10, 80) : 45;
//= one turn
apart = parts == 2;
//= both

// ---- the groove's cross-section: [outward from the floor, along the axis from the groove's middle], one half ----
// `lean`: angle of the wall from the outward direction. A u groove's floor is an arc of radius `seat`. A polygon around it
// replaces it, whose corners lie at most 0.01 mm off the arc.
seat = max(0.5, seat_ratio) * tendon;
function seat_corners(lean) = let (
    steps = max(1, ceil((90 - lean) / (2 * acos(1 / (1 + 0.01 / seat))))),
    step = (90 - lean) / steps,
    corner = seat / cos(step / 2))
  [for (k = [0 : steps - 1]) [k == 0 ? 0 : seat - corner * cos((k + 0.5) * step), corner * sin((k + 0.5) * step)]];
// the floor, up to where the straight wall begins
function ground(lean) =
  groove_shape == "u" ? seat_corners(lean) :
  groove_shape == "v" ? [[0, tendon / 2 * tan(45 - lean / 2)]] :
  [[0, 0.7 * tendon]];
function wall(lean) = let (
    corners = ground(lean),
    below_edge = [for (k = [0 : len(corners) - 1]) if (k == 0 || corners[k][0] < groove_depth) corners[k]],
    last = below_edge[len(below_edge) - 1])
  concat(below_edge, [[groove_depth, last[1] + (groove_depth - last[0]) * tan(lean)]]);
function width(wall) = wall[len(wall) - 1][1];
lower_wall = wall(groove_angle / 2);
ceiling_wall = wall(max(groove_angle / 2, slope));
//= one turn
// P1 is printed turned over if it is printed separately
p1_below = apart ? ceiling_wall : lower_wall;
p1_above = apart ? lower_wall : ceiling_wall;
p2_below = lower_wall;
p2_above = ceiling_wall;

// ---- heights ----
lower_cone = apart ? ceiling(lower_ledge) : 0;
middle_cone = apart ? 0 : ceiling(middle_ledge);
upper_cone = ceiling(upper_ledge);
// a channel's ceiling leaves 0.3 mm of the flange over it, in the middle of the pulley and at its entry in the groove edge
over_channel = channel_width / 2 + ceiling(channel_width) + 0.3;
over_entry = max(0, channel_width / 2 + entry_rise - max(width(lower_wall), width(ceiling_wall))) + 0.3;
ceiling_flange = max(flange_thickness, slope > 0 ? over_entry : 0);
over_pocket = channel_width / 2 + rise(knot_pocket) + min_wall;
z_p1 = apart ? max(ceiling_flange + lower_cone + width(p1_below), over_channel) : flange_thickness + width(p1_below);
z_middle = z_p1 + width(p1_above) + middle_cone;
// lower end of P2
z_mate = apart ? z_middle + flange_thickness
               : max(z_middle + ceiling_flange, z_p1 + over_channel, slope > 0 ? z_p1 + over_pocket : 0);
z_p2 = z_mate + (apart ? flange_thickness : 0) + width(p2_below);
z_top = z_p2 + max(width(p2_above) + upper_cone + ceiling_flange, over_channel);
//= both
has_hub = hub_diameter > 0 && hub_height > 0;
bore_edge = (bore + hole_compensation) / 2;
nut_room = set_screw && nut_trap ? nut_from_bore + nut_thickness / 2 : 0;
hub_radius = max(hub_diameter / 2, bore_edge + nut_room + hub_wall);
z_hub = z_top + (has_hub ? hub_height : 0);
//= one turn

// ---- outlines: curves parallel to a floor, circles, and the middle flange around both grooves ----
n = len(P1);
function parallel(P, out) = [for (p = P) [p[0] + out * cos(p[2]), p[1] + out * sin(p[2])]];
function circle_like(r) = [for (p = P1) r * [cos(p[2]), sin(p[2])]];
function reach(P, out) = max([for (p = parallel(P, out)) norm(p)]);
// components of a floor's point along its normal (the support function) and along its tangent (that function's derivative)
function support(p) = p[0] * cos(p[2]) + p[1] * sin(p[2]);
function support_slope(p) = -p[0] * sin(p[2]) + p[1] * cos(p[2]);
// the smooth maximum (log-sum-exp, in mm of `blend`) of both support functions is the support function h of the outline around
// both; t is its derivative
blend = 0.5;
function around_both(out) = [for (i = [0 : n - 1]) let (
    s1 = support(P1[i]), s2 = support(P2[i]), largest = max(s1, s2),
    w1 = exp((s1 - largest) / blend), w2 = exp((s2 - largest) / blend),
    h = largest + blend * ln(w1 + w2) + out,
    t = (w1 * support_slope(P1[i]) + w2 * support_slope(P2[i])) / (w1 + w2),
    a = P1[i][2]) [h * cos(a) - t * sin(a), h * sin(a) + t * cos(a)]];

is_round = flange_shape == "round";
reach1 = reach(P1, groove_depth);
reach2 = reach(P2, groove_depth);
lower = is_round ? circle_like(reach1 + lower_margin) : parallel(P1, groove_depth);
middle = is_round ? circle_like(max(reach1, reach2) + middle_margin) : around_both(groove_depth + middle_margin);
upper = is_round ? circle_like(reach2 + upper_margin) : parallel(P2, groove_depth);
// outline of the middle flange if P2 is printed separately
under_p2 = upper;

// ---- the body: rings [z, outline] from bottom to top, skinned ----
// the chamfer at the bed leaves 0.2 mm of the groove edge
foot = max(0, min(elephant_foot, groove_depth - 0.2, (flange_thickness - 0.2) / rise(1)));
function chamfered(rim) = [for (i = [0 : n - 1]) rim[i] - foot * [cos(P1[i][2]), sin(P1[i][2])]];
function on_bed_rings(z, rim) = concat(foot > 0 ? [[z, chamfered(rim)]] : [], [[z + rise(foot), rim]]);
function groove_rings(P, z, below, above) = concat(
  [for (k = [len(below) - 1 : -1 : 0]) [z - below[k][1], parallel(P, below[k][0])]],
  [for (k = [0 : len(above) - 1]) [z + above[k][1], parallel(P, above[k][0])]]);
p1_rings = concat(
  apart ? [[0, lower]] : on_bed_rings(0, lower),
  is_round ? [[z_p1 - width(p1_below) - lower_cone, lower]] : [],
  groove_rings(P1, z_p1, p1_below, p1_above),
  [[z_middle, middle]],
  apart ? [[z_mate - rise(foot), middle]] : [],
  apart && foot > 0 ? [[z_mate, chamfered(middle)]] : []);
p2_rings = concat(
  apart ? on_bed_rings(z_mate, under_p2) : [[z_p2 - width(p2_below), middle]],
  apart && is_round ? [[z_p2 - width(p2_below), under_p2]] : [],
  groove_rings(P2, z_p2, p2_below, p2_above),
  is_round ? [[z_p2 + width(p2_above) + upper_cone, upper]] : [],
  [[z_top, upper]]);

//= both
// The solid between sections with equal numbers of corners, one after the other. The first and the last are star-shaped
// about their first corner. OpenSCAD requires faces that turn clockwise. The sign of the volume gives the direction.
module strip(sections) {
  count = len(sections[0]);
  last = (len(sections) - 1) * count;
  points = [for (s = sections) each s];
  faces = concat(
    [for (c = [1 : count - 2]) each [[0, c, c + 1], [last, last + c + 1, last + c]]],
    [for (k = [0 : count : last - 1]) for (c = [0 : count - 1]) let (a = k + c, b = k + (c + 1) % count)
      each [[a, b + count, b], [a, a + count, b + count]]]);
  volume = [for (f = faces) 1] * [for (f = faces) points[f[0]] * cross(points[f[1]], points[f[2]])];
  // convexity: how often a line of sight can enter the solid, at most; the preview requires it
  polyhedron(points, volume < 0 ? faces : [for (f = faces) [f[0], f[2], f[1]]], convexity = 6);
}

function at(outline, z) = [for (p = outline) [p[0], p[1], z]];

//= one turn
module skin(rings) {
  strip([for (ring = rings) at(ring[1], ring[0])]);
}

//= both
// Separate from the body, because a wide bore makes it overhang the flange.
module hub() {
  translate([0, 0, z_top]) linear_extrude(z_hub - z_top) polygon(circle_like(hub_radius));
}

// ---- cut features ----
// A printer's corners cut inside of a curve, so that a round hole comes out too small. This hole is a polygon around
// the circle: its sides touch the circle of diameter d from outside, and a shaft of that diameter fits.
module polyhole(d, sides) {
  rotate(90 + 180 / sides) circle(r = d / 2 / cos(180 / sides), $fn = sides);
}

function sides(d) = max(8, round(2 * d));
module round_hole(d) { polyhole(d, sides(d)); }
// its edge in the direction a; from_middle: angle between a and the middle of the nearest side, which is d / 2 from the centre
function edge_of_hole(d, a) = let (side = 360 / sides(d), from_middle = a - 90 - side * round((a - 90) / side))
  d / 2 / cos(from_middle) * [cos(a), sin(a)];

module bore_outline() {
  d = bore + hole_compensation;
  key = bore_shape == "keyway" ? key_width + hole_compensation : 0;
  if (len(horn_teeth) > 0) polygon(horn_teeth);
  else if (bore_shape == "hex") polyhole(d, 6);
  else if (bore_shape == "square") polyhole(d, 4);
  else if (bore_shape == "d") intersection() { circle(d = d, $fn = 96); translate([-d, bore_flat - bore / 2 + hole_compensation / 2 - 2 * d]) square(2 * d); }
  else if (bore_shape == "keyway") { circle(d = d, $fn = 96); translate([-key / 2, 0]) square([key, d / 2 + key_depth]); }
  else round_hole(d);
}

// A recess narrows in a cone to the hole of its centre screw. Both ends have their corners on the same rays from the axis.
module recess_cone() {
  rim = len(horn_teeth) > 0 ? horn_teeth : [for (a = horn_rays) edge_of_hole(bore + hole_compensation, a)];
  hole = [for (a = horn_rays) edge_of_hole(horn_holes[0][2] + hole_compensation, a)];
  ledge = max([for (k = [0 : len(hole) - 1]) norm(rim[k] - hole[k])]);
  // the strip's end sections must be star-shaped: small round ones, which lie within the recess and the hole
  end = [for (a = horn_rays) horn_holes[0][2] / 4 * [cos(a), sin(a)]];
  top = horn_recess + rise(ledge);
  strip([at(end, horn_recess - 0.5), at(rim, horn_recess - 0.001), at(rim, horn_recess), at(hole, top), at(end, top + 0.5)]);
}

module bore_hole() {
  has_recess = horn_recess > 0;
  translate([0, 0, -1]) linear_extrude(1 + (has_recess ? horn_recess : z_hub + 1), convexity = 4) bore_outline();
  if (has_recess && slope > 0) recess_cone();
  for (hole = horn_holes) translate([hole[0], hole[1], -1]) linear_extrude(z_hub + 2) round_hole(hole[2] + hole_compensation);
}

//= one turn
// Blind holes: a cone closes each.
module dowel_holes() {
  d = dowel_pin + hole_compensation;
  end = min(z_p2 + dowel_end, z_top - 0.6 - ceiling(d / 2));
  for (centre = dowels) translate([centre[0], centre[1], 0]) {
    translate([0, 0, -1]) linear_extrude(end + 1) round_hole(d);
    if (slope > 0) translate([0, 0, end - 0.001]) linear_extrude(rise(d / 2), scale = 0.05) round_hole(d);
  }
}

// True if the face on which this pulley's pockets open lies on the bed: a pocket's ceiling is then an overhang.
function on_bed(groove) = groove == 1 && !apart && slope > 0;

// The channel in print orientation, with a ceiling that rises from its inner edge to its outer one.
module channel(t) {
  half = channel_width / 2;
  translate([0, 0, t[0] == 1 ? z_p1 : z_p2]) mirror([0, 0, t[0] == 1 && apart ? 1 : 0]) {
    strip([for (k = [0 : len(t[2]) - 1]) let (outer = t[2][k], inner = t[3][k], ridge = half + ceiling(norm(outer - inner)))
      [[inner[0], inner[1], -half], [outer[0], outer[1], -half], [outer[0], outer[1], ridge], [inner[0], inner[1], half]]]);
    if (knot_pocket > 0) pocket(t);
  }
}

// Relative to the pocket's middle, with x along the channel and y to its outer side: a circle. With `walled`, a rectangle as
// wide as the channel extends it backwards, and ends in a wall across the channel. It is 0.07 mm wider and longer, so that no
// faces coincide.
function pocket_outline(r, walled) = let (
    half = min((channel_width + 0.07) / 2, 0.95 * r), back = 180 - asin(half / r), step = 360 / facets,
    side = [for (k = [0 : facets - 1]) if (!walled || k * step < back - 0.3 * step) r * [cos(k * step), sin(k * step)]])
  !walled ? side : concat(side,
    [r * [cos(back), sin(back)], [-r - 0.07, half], [-r - 0.07, -half], r * [cos(back), -sin(back)]],
    [for (k = [len(side) - 1 : -1 : 1]) [side[k][0], -side[k][1]]]);

// The pocket opens on the nearer face. If that lies on the bed, its ceiling rises like the channel's.
module pocket(t) {
  inner_end = t[3][len(t[3]) - 1];
  outward = (t[1] - inner_end) / norm(t[1] - inner_end);
  // if no straight leads into the pocket: across the channel's end
  ahead = norm(t[4]) > 0 ? t[4] / norm(t[4]) : outward[0] * [0, 1] - outward[1] * [1, 0];
  r = knot_pocket / 2;
  open_end = t[0] == 2 ? z_hub - z_p2 + 1 : apart ? z_p1 + 1 : -z_p1 - 1;
  closed_end = (channel_width / 2 + 0.07) * (open_end > 0 ? -1 : 1);
  outline = pocket_outline(r, slope > 0 && norm(t[4]) > r + 0.07);
  edge = [for (p = outline) t[1] + p[0] * ahead + p[1] * outward];
  strip([at(edge, open_end), [for (k = [0 : len(edge) - 1])
    [edge[k][0], edge[k][1], closed_end + (on_bed(t[0]) ? rise(r + outline[k][1]) : 0)]]]);
}

// Children are given relative to the pulley's own face: it lies at 0 and faces down.
module from_face(groove) {
  translate([0, 0, groove == 1 ? 0 : z_top]) mirror([0, 0, groove == 1 ? 0 : 1]) children();
}

// A countersunk slot from the face to the groove: its inner end is round, and it is open to the rim. A closed hole would
// leave the groove's ceiling without support at its beginning.
module face_hole(t) {
  radius = channel_width / 2;
  normal = [cos(t[2]), sin(t[2])];
  to_groove = t[0] == 1 ? z_p1 : z_top - z_p2;
  outside = t[0] == 1 ? 1 : z_hub - z_top + 1;
  end = [for (k = [0 : facets]) let (a = t[2] + 90 + 180 * k / facets) t[1] + radius * [cos(a), sin(a)]];
  slot = concat(end, [end[facets] + t[5] * normal, end[0] + t[5] * normal]);
  around = [for (k = [0 : facets - 1]) [cos(360 * (k + 0.3) / facets), sin(360 * (k + 0.3) / facets)]];
  from_face(t[0]) {
    strip([at(slot, -outside), at(slot, to_groove + 0.03)]);
    // the countersink: a cone that narrows into the slot's round end
    if (t[4] > 0) strip([
      at([for (p = around) t[1] - (t[3] - radius) * normal + t[3] * p], -outside - 0.5),
      at([for (p = around) t[1] - (t[3] - radius) * normal + t[3] * p], 0),
      at([for (p = around) t[1] + 0.9 * radius * p], t[4] * (1 + 0.05 * radius / (t[3] - radius)))]);
  }
}

// A slot for the tail, flush in the face, with a peaked ceiling if that lies on the bed.
module tail_slot(t) {
  along = (t[2] - t[1]) / norm(t[2] - t[1]);
  across = channel_width / 2 * [-along[1], along[0]];
  function corner(p, side, z) = [p[0] + side * across[0], p[1] + side * across[1], z];
  from_face(t[0]) strip([for (p = [t[1], t[2]]) concat(
    [corner(p, -1, -1), corner(p, 1, -1), corner(p, 1, t[3])],
    t[4] > 0 ? [corner(p, 0, t[3] + t[4])] : [],
    [corner(p, -1, t[3])])]);
}

module clamp_pilot(t) {
  from_face(t[0]) translate([t[1][0], t[1][1], -1]) linear_extrude(t[3] + 1) round_hole(t[2] + hole_compensation);
}

//= both
// The set screw's hole is round below and has a peaked ceiling, so that it prints horizontally without support. It lies in
// the middle of the hub, or lower so that its ceiling has a wall above it, or higher so that the nut has clearance below.
module screw_hole() {
  top = screw_hole / 2 / cos(ridge_slope);
  z = max(min((z_top + z_hub) / 2, z_hub - top - min_wall), z_top + (nut_trap ? nut_width / sqrt(3) : screw_hole / 2));
  below = [for (k = [0 : facets]) let (a = 90 + ridge_slope + (360 - 2 * ridge_slope) * k / facets)
    screw_hole / 2 * [cos(a), sin(a)]];
  translate([0, 0, z]) rotate([0, 0, screw_angle]) rotate([90, 0, 90])
    linear_extrude(hub_radius + 1, convexity = 4) polygon(concat(below, [[0, top]]));
  if (nut_trap) rotate([0, 0, screw_angle])
    translate([bore_edge + nut_from_bore - nut_thickness / 2, -nut_width / 2, z - nut_width / sqrt(3)])
      cube([nut_thickness, nut_width, z_hub - z + nut_width / sqrt(3) + 1]);
}

//= one turn
// ---- the part ----
// `piece`: both pulleys as one (0), P1 (1) or P2 (2), at their positions in the assembled part. One difference: the cut features are
// united first, because they are small and this is fast.
module part(piece) {
  function has(groove) = piece == 0 || piece == groove;
  difference() {
    union() {
      skin(concat(has(1) ? p1_rings : [], has(2) ? p2_rings : []));
      if (has_hub && has(2)) hub();
    }
    union() {
      bore_hole();
      dowel_holes();
      for (t = channels) if (has(t[0])) channel(t);
      for (t = face_holes) if (has(t[0])) face_hole(t);
      for (t = tail_slots) if (has(t[0])) tail_slot(t);
      for (t = clamp_pilots) if (has(t[0])) clamp_pilot(t);
      if (set_screw && has_hub && has(2)) screw_hole();
    }
  }
}

// In print orientation: on the mating face.
module lying(piece) {
  rotate([piece == 1 ? 180 : 0, 0, 0]) translate([0, 0, -z_mate]) part(piece);
}

function far_side(rings) = max([for (ring = rings) each [for (p = ring[1]) p[0]]]);
function near_side(rings) = min([for (ring = rings) each [for (p = ring[1]) p[0]]]);

scale(print_scale) {
  if (show == "P1" || show == "P2") lying(show == "P1" ? 1 : 2);
  else if (show == "print" && apart) {
    lying(1);
    translate([far_side(p1_rings) - near_side(p2_rings) + 5 / print_scale, 0, 0]) lying(2);
  }
  else part(0);
}
//= several turns
// ---- the turns: rows of the groove's section along the spiral, `columns` rows a turn ----
// A row is [x, y, direction of the normal, height]; both grooves fall as that direction grows. Row j + columns lies below
// row j. Rows continue beyond the end of a groove, where they are filled to the groove edge: the tendon leaves the groove
// there through its run-out.
section = concat(
  [for (k = [len(lower_wall) - 1 : -1 : 0]) [lower_wall[k][0], -lower_wall[k][1]]],
  [for (p = ceiling_wall) p]);
m = len(section);
last1 = len(P1) - 1;
last2 = len(P2) - 1;
function normal_of(row) = [cos(row[2]), sin(row[2])];
function out_of(row, out) = [row[0], row[1]] + out * normal_of(row);
function lifted(p, z) = [p[0], p[1], z];
// How deep a row lies in the filled length: 0 in the groove, 1 at the end of the rows. j: row; front, back: filled rows at
// the first and the last end. The groove edges of filled rows project over the channel's entry, and less towards the end,
// by the ring's blend.
function fill_share(j, last, front, back) =
  j < front ? (front - j) / front : j + back > last ? (j + back - last) / back : 0;
function projection(share, k, edge_bulges) =
  share == 0 ? 0 : k == 0 ? edge_bulges[0] * (1 - blend(share)) : k == m - 1 ? edge_bulges[1] * (1 - blend(share)) : 0;
function row_points(P, front, back, edge_bulges) =
  [for (j = [0 : len(P) - 1]) let (share = fill_share(j, len(P) - 1, front, back)) for (k = [0 : m - 1])
    lifted(out_of(P[j], section[k][0] + projection(share, k, edge_bulges)), P[j][3] + section[k][1])];

// A closed ring along the first turn of an open spiral, or along its last turn (from_back). In its second half it is shifted
// gradually to the start of that turn, so that it closes. Point i is in column i.
function blend(share) = let (t = max(0, min(1, 2 * share - 1))) t * t * (3 - 2 * t);
function ring(P, first_column, from_back, out) = let (
    last = len(P) - 1,
    begin = P[from_back ? last : 0],
    next = P[from_back ? last - columns : columns],
    gap = [begin[0] - next[0], begin[1] - next[1]])
  [for (c = [0 : columns - 1]) let (
      k = (from_back ? last - c + first_column + 2 * columns : c - first_column + 2 * columns) % columns,
      row = P[from_back ? last - k : k])
    out_of(row, out) + blend(abs(row[2] - begin[2]) / abs(next[2] - begin[2])) * gap];

foot = max(0, min(elephant_foot, groove_depth - 0.2, (flange_thickness - 0.2) / rise(1)));
rings = concat(
  foot > 0 ? [at(ring(P1, first_column1, true, groove_depth - foot), 0)] : [],
  [at(ring(P1, first_column1, true, groove_depth), rise(foot)),
   at(ring(P1, first_column1, false, groove_depth), z_middle),
   at(ring(P2, first_column2, true, groove_depth), z_mate),
   at(ring(P2, first_column2, false, groove_depth), z_top)]);
count = len(rings);
first2 = len(P1) * m;
first_ring = first2 + len(P2) * m;

function quad(a, b, c, d) = [[a, b, c], [a, c, d]];
function after(c) = (c + 1) % columns;
function between(low, high) = [for (c = [0 : columns - 1]) each quad(low + c, low + after(c), high + after(c), high + c)];
// Faces of a groove of rows 0 … last, whose points begin at index `first`, between two rings, whose points begin at the indices
// `below` and `above`.
function winding(first, last, first_column, filled_front, filled_back, below, above) = let (n = columns)
  concat(
    // along the groove: from row to row
    [for (j = [0 : last - 1]) let (a = first + j * m, b = a + m)
      each j < filled_front || j + filled_back >= last ? quad(a, b, b + m - 1, a + m - 1)
        : [for (k = [0 : m - 2]) each quad(a + k, b + k, b + k + 1, a + k + 1)]],
    // its two end walls
    [for (k = [1 : m - 2]) let (a = first + filled_front * m) [a, a + k, a + k + 1]],
    [for (k = [1 : m - 2]) let (a = first + (last - filled_back) * m) [a, a + k + 1, a + k]],
    // ribs: from a turn's upper groove edge to the lower edge of the turn above
    [for (j = [0 : last - n - 1]) let (low = first + (j + n) * m + m - 1, high = first + j * m)
      each quad(low, low + m, high + m, high)],
    // from the ring below to the lowest turn, and from the highest to the ring above; at the spiral's end, past its end
    [for (j = [last - n + 1 : last - 1]) let (c = (first_column + j) % n, a = first + j * m)
      each quad(below + c, below + after(c), a + m, a)],
    let (j = last - n, c = (first_column + j) % n, r0 = below + after(c), r1 = first + (j + 1) * m,
         l0 = below + c, l1 = first + last * m, l2 = l1 + m - 1, l3 = first + j * m)
      [[l0, r0, l1], [l1, r0, r1], [l1, r1, l2], [l2, r1, l3]],
    [for (j = [0 : n - 2]) let (c = (first_column + j) % n, a = first + j * m + m - 1)
      each quad(a, a + m, above + after(c), above + c)],
    let (j = n - 1, c = (first_column + j) % n, l0 = first + j * m + m - 1, l1 = above + c,
         r0 = first + n * m + m - 1, r1 = first, r2 = first + m - 1, r3 = above + after(c))
      [[l0, r0, r1], [l0, r1, r2], [l0, r2, l1], [l1, r2, r3]]);

module body() {
  points = concat(row_points(P1, 0, filled1, edge_bulges1), row_points(P2, filled2, 0, edge_bulges2), [for (r = rings) each r]);
  rim = first_ring + (count - 4) * columns;
  faces = concat(
    [[for (c = [columns - 1 : -1 : 0]) first_ring + c]],
    foot > 0 ? between(first_ring, rim) : [],
    winding(0, last1, first_column1, 0, filled1, rim, rim + columns),
    between(rim + columns, rim + 2 * columns),
    winding(first2, last2, first_column2, filled2, 0, rim + 2 * columns, rim + 3 * columns),
    [[for (c = [0 : columns - 1]) rim + 3 * columns + c]]);
  // OpenSCAD requires faces that turn clockwise
  polyhedron(points, [for (f = faces) [for (k = [len(f) - 1 : -1 : 0]) f[k]]], convexity = 20);
}

function circle_like(r) = [for (k = [0 : 95]) r * [cos(3.75 * k), sin(3.75 * k)]];

// ---- run-outs: tangentially out of a groove's end, along an arc inwards and towards the face, into a knot pocket ----
// A run-out is [row where the groove ends, +1 if it goes on towards growing directions or -1 towards falling ones, -1 if it
// leads to the lower face or +1 to the upper one, that face's height, the entry of run_outs].
channel = channel_width / 2;
pocket = max(knot_pocket / 2, 1.05 * channel);

// The section across the direction `ahead` of the volume that a ball with a cone on it sweeps: a circle of radius r about
// `centre` below a peaked ceiling, whose ridge is vertically over the centre.
channel_slope = max(ridge_slope, 57.5);
function tube(centre, ahead, r) = let (
    level = [ahead[1], -ahead[0], 0] / norm([ahead[0], ahead[1]]),
    up = cross(level, ahead),
    gap = acos(cos(channel_slope) / up[2]),
    sides = [for (k = [0 : facets]) let (a = 90 + gap + (360 - 2 * gap) * k / facets) cos(a) * level + sin(a) * up])
  [for (p = concat(sides, [[0, 0, 1 / cos(channel_slope)]])) centre + r * p];

module run_out(t) {
  row = t[0];
  normal = lifted(normal_of(row), 0);
  along = t[1] * [-normal[1], normal[0], 0];
  towards = (t[2] * [0, 0, 1] - normal) / sqrt(2);
  start = lifted(out_of(row, tendon / 2), row[3]);
  bend = t[4][0];
  cone = rise(pocket - channel);
  top = lifted(t[4][1], t[3] - t[2] * (t[4][2] + cone));
  arc_end = start + bend * (along + towards);
  end = tube(top, towards, channel);
  front = top + channel * (cos(channel_slope) * [0, 0, 1] - sin(channel_slope) * normal);
  strip(concat(
    [for (x = [-0.02, 0.06]) tube(start + x * along, along, min(tendon / 2, channel))],
    [for (k = [1 : 9]) let (a = 10 * k)
      tube(start + bend * (sin(a) * along + (1 - cos(a)) * towards), cos(a) * along + sin(a) * towards, channel)],
    // into the lower pocket; before the upper one it ends in a point, because a flat end would have a ceiling
    t[2] < 0 ? [tube(top + 0.8 * channel * towards, towards, channel)]
             : concat(norm(top - arc_end) > 0.05 * channel ? [end] : [], [[for (p = end) front + 0.05 * (p - front)]])));
  around = [for (k = [0 : facets - 1]) [cos(360 * (k + 0.23) / facets), sin(360 * (k + 0.23) / facets)]];
  neck = min(pocket, channel);  // at this radius the pocket of the lower face goes on to a tip, because a flat end would be a ceiling
  strip([for (s = concat([[-1, pocket], [t[4][2], pocket], [t[4][2] + cone, channel]],
                         t[2] < 0 ? [[t[4][2] + cone + rise(0.8 * neck), 0.2 * neck]] : []))
    [for (p = around) lifted(t[4][1], t[3] - t[2] * s[0]) + s[1] * lifted(p, 0)]]);
}

// ---- the part ----
// One difference: the cut features are united first, because they are small and this is fast.
scale(print_scale) difference() {
  union() {
    body();
    if (has_hub) hub();
  }
  union() {
    bore_hole();
    for (t = [[P1[last1 - filled1], 1, -1, 0, run_outs[0]], [P2[filled2], -1, 1, z_top, run_outs[1]]]) run_out(t);
    if (set_screw && has_hub) screw_hole();
  }
}
