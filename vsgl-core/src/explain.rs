//! The error of a picture, split by cause: a chain of pictures from the tested one to the truth, each of which has one cause less
//! than the one before.
//!
//! All pictures are luminance of indirect light. What two that follow each other differ by is signed, so that all differences add up to
//! the whole error, pixel by pixel. What a cause is found to be depends on the order in which causes are taken away: see
//! [`Cause::ALL`].

use crate::error::{Error, Result};
use crate::metrics::EPS_SHARE;

/// What makes a picture differ from the truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Cause {
    /// A pixel takes a share of the virtual lights, and neighbours' sums.
    Interleaving,
    /// Shadow maps have few texels and points.
    MapSize,
    /// What blocks light is found by something else than a ray from each pixel to each virtual light, or not at all.
    Occlusion,
    /// A cluster is seen or not seen as its one point is.
    Visibility,
    /// What leaves a cluster towards a receiver is not what leaves its texels.
    Emission,
    /// What a receiver reflects of a cluster's lobe is not what it reflects of the texels' light.
    Integral,
    /// The three above together, where texels have no cluster of their own.
    Clusters,
    /// Reflective shadow maps have few texels.
    Rsm,
    /// What is left at the samples: all that is finer still, light of short distances that is bounded, and noise.
    Rest,
    /// Pixels are looked at in few points.
    Pixels,
}

impl Cause {
    /// All causes in the order in which they are taken away: from what is done last in a frame to what is done first.
    ///
    /// Interleaving comes first since it mixes pixels: all that follows is found for each sample on its own. Visibility of a cluster is
    /// asked before its emission and its integral are made exact, with the light that the method itself gives it.
    pub const ALL: &'static [Self] = &[
        Self::Interleaving,
        Self::MapSize,
        Self::Occlusion,
        Self::Visibility,
        Self::Emission,
        Self::Integral,
        Self::Clusters,
        Self::Rsm,
        Self::Rest,
        Self::Pixels,
    ];

    /// Spelling in reports and names of files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Interleaving => "interleaving",
            Self::MapSize => "map-size",
            Self::Occlusion => "occlusion",
            Self::Visibility => "visibility",
            Self::Emission => "emission",
            Self::Integral => "integral",
            Self::Clusters => "clusters",
            Self::Rsm => "rsm",
            Self::Rest => "rest",
            Self::Pixels => "pixels",
        }
    }

    /// What it is, in some words.
    pub fn title(self) -> &'static str {
        match self {
            Self::Interleaving => "shares of the lights",
            Self::MapSize => "size of the shadow maps",
            Self::Occlusion => "how occlusion is found",
            Self::Visibility => "visibility at one point a cluster",
            Self::Emission => "emission form",
            Self::Integral => "integral at the receiver",
            Self::Clusters => "clusters instead of texels",
            Self::Rsm => "RSM resolution",
            Self::Rest => "the rest, and noise",
            Self::Pixels => "samples a pixel",
        }
    }
}

/// One picture of the chain, in two halves made with random numbers of their own; their mean counts. Equal where none were drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Luminance of each pixel \[W/(m² sr)\].
    pub halves: [Vec<f64>; 2],
}

impl Picture {
    /// A picture without noise.
    pub fn exact(values: Vec<f64>) -> Self {
        Self {
            halves: [values.clone(), values],
        }
    }

    /// Mean of the halves.
    pub fn mean(&self) -> Vec<f64> {
        self.combine(|a, b| 0.5 * (a + b))
    }

    fn combine(&self, f: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        let [a, b] = &self.halves;
        a.iter().zip(b).map(|(&a, &b)| f(a, b)).collect()
    }

    /// What this picture has more than another.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        let half = |h: usize| {
            let pairs = self.halves[h].iter().zip(&other.halves[h]);
            pairs.map(|(a, b)| a - b).collect()
        };
        Self {
            halves: [half(0), half(1)],
        }
    }
}

/// How much of an error one difference is, in percent of the truth.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Part {
    /// `100 mean(e) / mean(r)`: adds up over the causes to the bias of the picture.
    pub bias: f64,
    /// `100 mean(|e| / max(r, eps))`, noise included. Does not add up: causes may be in each other's way.
    pub mape: f64,
    /// `100 sqrt(mean(e² / max(r, eps)²))` without noise: of `e²` the product of the two halves is taken, whose noise is not the
    /// same. Zero where noise leaves that below zero.
    pub rmspe: f64,
    /// `100 mean(e w / max(r, eps)²) / mean(w² / max(r, eps)²)` with the whole error `w`, products taken likewise: adds up to 100.
    /// Negative where a cause undoes others.
    pub share: f64,
    /// The noise of `e`, as a `rmspe`: what was drawn at random, the truth's paths included.
    pub noise: f64,
}

/// A truth, and what a picture is wrong by.
///
/// Blocks and pixels that are left out, and `eps`, are as in [`crate::metrics`]: a truth of 0, or what is not finite.
#[derive(Clone, Debug)]
pub struct Yardstick {
    width: usize,
    height: usize,
    truth: Vec<f64>,
    whole: Picture,
}

/// Means over a block.
struct Block {
    truth: f64,
    /// Halves of the whole error and of the difference.
    whole: [f64; 2],
    step: [f64; 2],
}

impl Yardstick {
    /// Of pictures `width` by `height` pixels, row-major.
    ///
    /// # Errors
    /// [`Error::Columns`] if a picture has another number of pixels.
    pub fn new(width: u32, height: u32, truth: &Picture, tested: &Picture) -> Result<Self> {
        let (width, height) = (width as usize, height as usize);
        for half in [truth, tested].into_iter().flat_map(|p| &p.halves) {
            if half.len() != width * height {
                let problem = format!("{} values for {width}x{height} pixels", half.len());
                return Err(Error::Columns {
                    resource: "explain",
                    problem,
                });
            }
        }
        Ok(Self {
            width,
            height,
            truth: truth.mean(),
            whole: tested.minus(truth),
        })
    }

    /// The truth, row-major.
    pub fn truth(&self) -> &[f64] {
        &self.truth
    }

    /// The whole error.
    pub fn whole(&self) -> &Picture {
        &self.whole
    }

    /// Blocks that are compared.
    fn blocks(&self, step: &Picture, side: usize) -> Vec<Block> {
        let mut blocks = Vec::new();
        for row in 0..self.height / side {
            for column in 0..self.width / side {
                let mut sums = [0.0; 5];
                let mut fits = true;
                let corner = row * side * self.width + column * side;
                for at in (0..side * side).map(|i| corner + i / side * self.width + i % side) {
                    let [[a, b], [c, d]] =
                        [&self.whole, step].map(|p| [0, 1].map(|h| p.halves[h][at]));
                    let values = [self.truth[at], a, b, c, d];
                    fits &= values[0] != 0.0 && values.iter().all(|v| v.is_finite());
                    for (sum, value) in sums.iter_mut().zip(values) {
                        *sum += value;
                    }
                }
                let [truth, a, b, c, d] = sums.map(|s| s / (side * side) as f64);
                if fits {
                    blocks.push(Block {
                        truth,
                        whole: [a, b],
                        step: [c, d],
                    });
                }
            }
        }
        blocks
    }

    /// How much of the error a difference is, over means of blocks of `side` by `side` pixels; none if nothing is left to compare.
    pub fn part(&self, step: &Picture, side: u32) -> Option<Part> {
        let blocks = self.blocks(step, side.max(1) as usize);
        if blocks.is_empty() {
            return None;
        }
        let mean =
            |f: &dyn Fn(&Block) -> f64| blocks.iter().map(f).sum::<f64>() / blocks.len() as f64;
        let reference = mean(&|b| b.truth).abs().max(f64::MIN_POSITIVE);
        let eps = (EPS_SHARE * reference).max(f64::MIN_POSITIVE);
        let middle = |[a, b]: [f64; 2]| 0.5 * (a + b);
        // Halves of one error with the others of another.
        let product = |f: &dyn Fn(&Block) -> [[f64; 2]; 2]| {
            mean(&|block| {
                let [a, b] = f(block);
                let scale = block.truth.max(eps);
                0.5 * (a[0] * b[1] + a[1] * b[0]) / (scale * scale)
            })
        };
        let square = product(&|b| [b.whole, b.whole]);
        let noise = mean(&|b| {
            let apart = 0.5 * (b.step[0] - b.step[1]) / b.truth.max(eps);
            apart * apart
        });
        Some(Part {
            bias: 100.0 * mean(&|b| middle(b.step)) / reference,
            mape: 100.0 * mean(&|b| middle(b.step).abs() / b.truth.max(eps)),
            rmspe: 100.0 * product(&|b| [b.step, b.step]).max(0.0).sqrt(),
            share: if square > 0.0 {
                100.0 * product(&|b| [b.step, b.whole]) / square
            } else {
                0.0
            },
            noise: 100.0 * noise.sqrt(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::{Metric, Plane, compare};

    fn pictures() -> (Picture, Vec<Picture>) {
        let value = |i: usize, k: usize| 1.0 + ((i * 37 + k * 101) % 64) as f64 / 64.0;
        let picture = |k: usize| Picture::exact((0..256).map(|i| value(i, k)).collect());
        (picture(9), (0..4).map(picture).collect())
    }

    #[test]
    fn bias_and_share_add_up_to_the_whole() {
        let (truth, chain) = pictures();
        let yardstick = Yardstick::new(16, 16, &truth, &chain[0]).expect("of one size");
        for side in [1, 8] {
            let mut all = chain.clone();
            all.push(truth.clone());
            let parts: Vec<Part> = all
                .windows(2)
                .map(|w| yardstick.part(&w[0].minus(&w[1]), side).expect("lit"))
                .collect();
            let whole = yardstick.part(&chain[0].minus(&truth), side).expect("lit");
            let sum = |f: fn(&Part) -> f64| parts.iter().map(f).sum::<f64>();
            assert!((sum(|p| p.bias) - whole.bias).abs() < 1e-9);
            assert!((sum(|p| p.share) - 100.0).abs() < 1e-9);
            assert!((whole.share - 100.0).abs() < 1e-9 && whole.noise == 0.0);
        }
    }

    #[test]
    fn the_whole_error_is_that_of_the_metrics() {
        let (mut truth, chain) = pictures();
        truth.halves.iter_mut().for_each(|h| h[3] = 0.0);
        let yardstick = Yardstick::new(16, 16, &truth, &chain[1]).expect("of one size");
        let plane = |p: &Picture| Plane::new(16, 16, p.mean()).expect("of this size");
        for side in [1, 8] {
            let errors = compare(&plane(&chain[1]), &plane(&truth), side)
                .expect("of one size")
                .expect("lit");
            let part = yardstick.part(&chain[1].minus(&truth), side).expect("lit");
            for (metric, value) in [
                (Metric::Bias, part.bias),
                (Metric::Mape, part.mape),
                (Metric::Rmspe, part.rmspe),
            ] {
                assert!(
                    (errors.get(metric) - value).abs() < 1e-9,
                    "{}",
                    metric.word()
                );
            }
        }
    }

    #[test]
    fn noise_is_half_of_what_the_halves_differ_by() {
        let truth = Picture::exact(vec![1.0; 64]);
        let tested = Picture {
            halves: [vec![1.3; 64], vec![1.1; 64]],
        };
        let yardstick = Yardstick::new(8, 8, &truth, &tested).expect("of one size");
        let part = yardstick.part(&tested.minus(&truth), 1).expect("lit");
        assert!((part.noise - 10.0).abs() < 1e-9 && (part.mape - 20.0).abs() < 1e-9);
        // 0.3 · 0.1 is what 0.2² has without noise of 0.1².
        assert!((part.rmspe - 100.0 * 0.03f64.sqrt()).abs() < 1e-9);
        let dark = Yardstick::new(8, 8, &Picture::exact(vec![0.0; 64]), &tested).expect("same");
        assert_eq!(dark.part(&tested, 1), None);
        assert!(Yardstick::new(9, 8, &truth, &tested).is_err());
    }
}
