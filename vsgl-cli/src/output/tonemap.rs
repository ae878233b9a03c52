//! From linear light to what a screen can show.

/// A tone curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Tonemap {
    /// Khronos PBR Neutral: colours of surfaces stay, highlights are compressed.
    Neutral,
    /// None: what is above 1 is clipped.
    None,
}

impl Tonemap {
    /// Spelling on the command line.
    pub fn word(self) -> &'static str {
        match self {
            Self::Neutral => "neutral",
            Self::None => "none",
        }
    }

    /// Linear display colour of an exposed linear colour.
    pub fn apply(self, color: [f32; 3]) -> [f32; 3] {
        match self {
            Self::Neutral => neutral(color),
            Self::None => color,
        }
    }
}

/// Peak up to which nothing is compressed.
const COMPRESSION_START: f32 = 0.8 - 0.04;
/// How fast highlights lose saturation.
const DESATURATION: f32 = 0.15;

/// The Khronos PBR Neutral tone curve.
///
/// It takes off the 4 % that a dielectric reflects of a white surrounding, so that base colours come out as they are,
/// and compresses peaks above 0.8 towards 1. Negative light, which no renderer should send, is taken for none.
///
/// Source: Khronos Group 2024, "Khronos PBR Neutral Tone Mapper", specification.
pub fn neutral(color: [f32; 3]) -> [f32; 3] {
    let color = color.map(|c| if c > 0.0 { c.min(1e30) } else { 0.0 });
    let least = color[0].min(color[1]).min(color[2]);
    let offset = if least < 0.08 {
        least - 6.25 * least * least
    } else {
        0.04
    };
    let color = color.map(|c| c - offset);
    let peak = color[0].max(color[1]).max(color[2]);
    if peak < COMPRESSION_START {
        return color;
    }
    let room = 1.0 - COMPRESSION_START;
    let new_peak = 1.0 - room * room / (peak + room - COMPRESSION_START);
    let white = 1.0 - 1.0 / (DESATURATION * (peak - new_peak) + 1.0);
    color.map(|c| {
        let scaled = c * (new_peak / peak);
        scaled + (new_peak - scaled) * white
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: [f32; 3], b: [f32; 3]) {
        for lane in 0..3 {
            assert!((a[lane] - b[lane]).abs() < 1e-6, "{a:?} is not {b:?}");
        }
    }

    /// Values worked out from the formulas of the specification in double precision.
    #[test]
    fn the_curve_goes_through_its_published_points() {
        close(neutral([0.0; 3]), [0.0; 3]);
        // Toe: 6.25 x² up to 0.08, then x - 0.04.
        close(neutral([0.04; 3]), [0.01; 3]);
        close(neutral([0.08; 3]), [0.04; 3]);
        close(neutral([0.5; 3]), [0.46; 3]);
        // The compression begins at 0.8 without a step.
        close(neutral([0.8; 3]), [0.76; 3]);
        // Peak 0.96: 1 - 0.0576 / (0.96 + 0.24 - 0.76).
        close(neutral([1.0; 3]), [0.869_090_9; 3]);
        // A bright red turns towards white: peak 4, new peak 1 - 0.0576/3.48.
        let new_peak = 1.0 - 0.0576 / 3.48;
        let white = 1.0 - 1.0 / (0.15 * (4.0 - new_peak) + 1.0);
        close(
            neutral([4.0, 0.0, 0.0]),
            [new_peak, new_peak * white, new_peak * white],
        );
    }

    #[test]
    fn the_curve_rises_and_stays_below_one() {
        let mut last = -1.0;
        for step in 0..20_000 {
            let [value, ..] = neutral([step as f32 * 1e-3; 3]);
            assert!(value >= last && value < 1.0, "{step}");
            last = value;
        }
        for odd in [f32::NAN, f32::INFINITY, -1.0] {
            assert!(
                neutral([odd, 0.5, 0.0])
                    .iter()
                    .all(|c| (0.0..=1.0).contains(c))
            );
        }
    }
}
