//! How far apart two backends may be.

/// What is tolerated, and the name of the tier for reports.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Name of the tier.
    pub name: &'static str,
    /// How far values may be apart where decisions agree.
    pub values: Values,
    /// Share of the entries of a decision column that may differ.
    pub decisions: f64,
}

/// How far values may be apart.
///
/// A relative error is the difference over the reference's size: of a number its absolute value, of a vector that of its
/// largest component. Sizes below `floor` times the column's mean count as that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Values {
    /// Equal bits; +0 equals −0.
    Bits,
    /// No component further than `limit`.
    Relative {
        /// Greatest relative error that passes.
        limit: f64,
        /// Share of the mean below which sizes count as that share.
        floor: f64,
    },
    /// Most components near, a few further, whatever the worst one is: for hardware, where one rounding may turn a
    /// shadow ray.
    Shares {
        /// Relative errors, each with the share of the components that may be above it.
        steps: &'static [(f64, f64)],
        /// Share of the mean below which sizes count as that share.
        floor: f64,
    },
}

impl Values {
    /// The share of the mean below which sizes count as that share.
    pub fn floor(self) -> f64 {
        match self {
            Self::Bits => FLOOR,
            Self::Relative { floor, .. } | Self::Shares { floor, .. } => floor,
        }
    }
}

/// Share of the mean below which sizes count as that share: what is so small is often the difference of larger numbers,
/// and has their rounding.
const FLOOR: f64 = 1e-4;

impl Tolerance {
    /// Software drivers whose shaders keep the order of operations: the arithmetic of IEEE 754 leaves no choice, so every
    /// bit must agree.
    pub const STRICT: Self = Self {
        name: "strict",
        values: Values::Bits,
        decisions: 0.0,
    };
    /// Software drivers as they come: compilers regroup sums and products, which was measured to change a component by
    /// 6e-6 at worst; about three times that. A decision may turn where it was a matter of one rounding.
    pub const SOFTWARE: Self = Self {
        name: "ordinary",
        values: Values::Relative {
            limit: 2e-5,
            floor: FLOOR,
        },
        decisions: 1e-4,
    };
    /// Hardware: multiplications may fuse with additions, division and square root may be off by 2.5 units in the last
    /// place, and small numbers may be flushed to zero.
    pub const HARDWARE: Self = Self {
        name: "hardware",
        values: Values::Shares {
            steps: &[(1e-3, 1e-3), (1e-2, 1e-4)],
            floor: FLOOR,
        },
        decisions: 1e-3,
    };

    /// The same for paths of light drawn at random: each surface that a path meets magnifies the rounding of its direction, by
    /// the inverse of its roughness and of its size, and what is drawn may turn by one rounding. So a few numbers of a picture
    /// may be as they like; strict mode still asks for every bit.
    #[must_use]
    pub fn of_paths(self) -> Self {
        let shares = |steps| Values::Shares {
            steps,
            floor: self.values.floor(),
        };
        let values = match self.values {
            Values::Bits => Values::Bits,
            Values::Relative { .. } => shares(&[(1e-4, 1e-2), (1e-2, 1e-3)]),
            Values::Shares { .. } => shares(&[(1e-3, 2e-2), (1e-2, 5e-3)]),
        };
        Self { values, ..self }
    }

    /// What passes, in a line.
    pub fn describe(&self) -> String {
        let values = match self.values {
            Values::Bits => "equal bits".to_owned(),
            Values::Relative { limit, .. } => format!("relative error at most {limit:e}"),
            Values::Shares { steps, .. } => {
                let step = |(limit, share): &(f64, f64)| {
                    format!("{} % within {limit:e}", 100.0 * (1.0 - share))
                };
                steps.iter().map(step).collect::<Vec<_>>().join(", ")
            }
        };
        match self.decisions {
            0.0 => format!("{values}; all decisions equal"),
            share => format!("{values}; decisions differ in at most {} %", 100.0 * share),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiers_say_what_passes() {
        assert_eq!(
            Tolerance::STRICT.describe(),
            "equal bits; all decisions equal"
        );
        assert_eq!(
            Tolerance::SOFTWARE.describe(),
            "relative error at most 2e-5; decisions differ in at most 0.01 %"
        );
        assert_eq!(
            Tolerance::HARDWARE.describe(),
            "99.9 % within 1e-3, 99.99 % within 1e-2; decisions differ in at most 0.1 %"
        );
    }
}
