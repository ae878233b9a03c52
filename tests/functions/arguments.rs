//! Arguments for the functions: random ones in sensible ranges, and the ends of the ranges, branches and special numbers.

use vsgl_core::glam::Vec3;
use vsgl_core::sg::lobe::SHARPNESS_MAX;

/// What an argument is; one to three columns of numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    /// Unit vector; also along the axes, and near, equal, opposite to or mirrored about an earlier one of the same call.
    Unit,
    /// The same with `z` from 0 to 1, in a tangent frame.
    Upper,
    /// Vector of a length from the first to the second, also zero.
    Vector(f32, f32),
    /// Sharpness, logarithmically from 1e-6 to the largest; also 0 and beyond the largest.
    Sharpness,
    /// From −1 to 1, also near the ends and 0.
    Cosine,
    /// Unit vector in a plane; two columns.
    Turn,
    /// Roughness, logarithmically from 1e-3 to 1; also down to 1e-6.
    Alpha,
    /// The same, also 0: for what clamps it.
    AnyAlpha,
    /// Evenly from the first to the second.
    Even(f32, f32),
    /// Logarithmically, positive, from the first to the second; also the ends and 0.
    Positive(f32, f32),
    /// Logarithmically, of both signs.
    Signed(f32, f32),
}
use Kind::*;

/// Numbers at which texts branch or clamp, their likes and special ones.
const SPECIAL: [f32; 29] = [
    0.0,
    -0.0,
    f32::MIN_POSITIVE,
    -f32::MIN_POSITIVE,
    1e-30,
    1e-18,
    1e-9,
    1e-6,
    1e-4,
    0.25,
    0.5,
    1.0,
    -1.0,
    2.0,
    -2.0,
    3.5,
    3.75,
    3.9,
    -3.9,
    4.0,
    10.0,
    -30.0,
    33.0,
    -87.0,
    87.5,
    88.0,
    1e4,
    1e6,
    1e30,
];

impl Kind {
    /// How many columns it has.
    pub(super) fn width(self) -> usize {
        match self {
            Unit | Upper | Vector(..) => 3,
            Turn => 2,
            _ => 1,
        }
    }

    /// Appends one argument to those of a call.
    fn draw(self, random: &mut Random, special: bool, row: &mut Vec<f32>, units: &mut Vec<Vec3>) {
        match self {
            Unit | Upper => {
                let mut v = unit(random, special, units);
                if self == Upper {
                    v.z = v.z.abs();
                }
                units.push(v);
                row.extend(v.to_array());
            }
            Vector(low, high) => {
                let length = random.logarithmic(random.least(low), high);
                let zero = special && random.below(4) == 0;
                let v = unit(random, special, units) * if zero { 0.0 } else { length };
                row.extend(v.to_array());
            }
            Sharpness if special => {
                row.push(random.special(0.0, f32::MAX, &[SHARPNESS_MAX, f32::MAX]));
            }
            Sharpness => row.push(random.logarithmic(1e-6, SHARPNESS_MAX)),
            Cosine if special => row.push(random.special(-1.0, 1.0, &[])),
            Cosine => row.push(random.even(-1.0, 1.0)),
            Turn => {
                let turn = random.even(0.0, std::f32::consts::TAU);
                let quarter = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
                let (sin, cos) = turn.sin_cos();
                let some = quarter[random.below(4) as usize];
                let (x, y) = if special { some } else { (cos, sin) };
                row.extend([x, y]);
            }
            Alpha | AnyAlpha if special && random.gentle => {
                row.push(random.special(1e-3, 1.0, &[]))
            }
            Alpha if special => row.push(random.special(1e-6, 1.0, &[1e-3, 1.525_878_9e-5])),
            AnyAlpha if special => row.push(random.special(0.0, 1.0, &[1e-3, 1.525_878_9e-5])),
            Alpha | AnyAlpha => row.push(random.logarithmic(1e-3, 1.0)),
            Even(low, high) if special => row.push(random.special(low, high, &[low, high])),
            Even(low, high) => row.push(random.even(low, high)),
            Positive(low, high) if special => {
                row.push(random.special(0.0, high, &[low, high]));
            }
            Positive(low, high) => row.push(random.logarithmic(random.least(low), high)),
            Signed(_, high) if special => row.push(random.special(-high, high, &[high, -high])),
            Signed(low, high) => {
                let size = random.logarithmic(random.least(low), high);
                row.push(if random.below(2) == 0 { size } else { -size });
            }
        }
    }
}

/// A unit vector; those of one call are often close to each other, since lobes matter where they meet.
fn unit(random: &mut Random, special: bool, earlier: &[Vec3]) -> Vec3 {
    let height = random.even(-1.0, 1.0);
    let turn = random.even(0.0, std::f32::consts::TAU);
    let ring = (1.0 - height * height).max(0.0).sqrt();
    let free = Vec3::new(ring * turn.cos(), ring * turn.sin(), height);
    let near = if random.gentle { 1e-4 } else { 1e-8 };
    let v = match (earlier, random.below(8)) {
        (_, 0 | 1) if special => {
            let mut axis = [0.0; 3];
            axis[random.below(3) as usize] = if random.below(2) == 0 { 1.0 } else { -1.0 };
            return Vec3::from_array(axis);
        }
        ([.., last], 2) if special => return *last,
        ([.., last], 3) if special => return -*last,
        ([.., last], 4) => *last + free * random.logarithmic(near, 1.0),
        // Half vectors of opposite directions are so short that their fourth powers count.
        ([.., last], 5) => free * random.logarithmic(near, 1e-2) - *last,
        // Near the mirrored direction of the first about the second.
        ([first, second, ..], 6) => first.reflect(*second) + free * random.logarithmic(1e-8, 0.3),
        // Perpendicular to the last but a little.
        ([.., last], 7) => free.cross(*last) + free * random.logarithmic(1e-8, 1e-2),
        _ => free,
    };
    // Normalised in double precision: within half a rounding of unit length.
    let length = v.as_dvec3().length();
    if length > 1e-12 {
        (v.as_dvec3() / length).as_vec3()
    } else {
        free
    }
}

/// The arguments of `count` calls, one call after the other. In an eighth of them half the arguments are special.
///
/// `gentle` keeps from numbers whose squares or products leave the normal ones, for devices that have no others.
pub(super) fn rows(kinds: &[Kind], count: usize, seed: u64, gentle: bool) -> Vec<f32> {
    let mut random = Random {
        state: seed,
        gentle,
    };
    let width: usize = kinds.iter().map(|k| k.width()).sum();
    let mut all = Vec::with_capacity(count * width);
    let mut units = Vec::new();
    for i in 0..count {
        units.clear();
        for kind in kinds {
            let special = i % 8 == 0 && random.below(2) == 0;
            kind.draw(&mut random, special, &mut all, &mut units);
        }
    }
    all
}

/// A generator that is the same everywhere (Vigna 2015, "splitmix64").
struct Random {
    state: u64,
    gentle: bool,
}

impl Random {
    fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: u64) -> u64 {
        (self.next() >> 32) % n
    }

    fn even(&mut self, low: f32, high: f32) -> f32 {
        let u = (self.next() >> 40) as f32 * (1.0 / 16_777_216.0);
        (low + (high - low) * u).clamp(low, high)
    }

    /// Evenly among the representable numbers between two positive ones: close to logarithmic, and cheap.
    fn logarithmic(&mut self, low: f32, high: f32) -> f32 {
        let span = u64::from(high.to_bits() - low.to_bits()) + 1;
        f32::from_bits(low.to_bits() + self.below(span) as u32)
    }

    /// A special number within a range or one of `more`, or a neighbour of it.
    fn special(&mut self, low: f32, high: f32, more: &[f32]) -> f32 {
        let pick = self.below((SPECIAL.len() + 2 * more.len()) as u64) as usize;
        let x = match SPECIAL.get(pick) {
            Some(x) => *x,
            None => more[(pick - SPECIAL.len()) % more.len()],
        };
        let x = match self.below(4) {
            0 => x.next_up(),
            1 => x.next_down(),
            _ => x,
        };
        let x = if self.gentle && x.abs() < 1e-9 {
            0.0
        } else {
            x
        };
        x.clamp(low, high)
    }

    /// Least size of an argument where `low` was asked for.
    fn least(&self, low: f32) -> f32 {
        if self.gentle { low.max(1e-12) } else { low }
    }
}
