//! How far pictures are from the reference, as the documents of a sweep have it.

use crate::exit::Result;
use crate::picture::Picture;
use serde_json::{Map, Value};
use vsgl_core::metrics::{Metric, Plane, compare};

/// Metrics of a sweep.
const METRICS: [Metric; 6] = [
    Metric::Rmspe,
    Metric::Mape,
    Metric::MapeMedian,
    Metric::Smape,
    Metric::Relmse,
    Metric::Bias,
];

/// Luminance of what is compared.
pub(crate) struct Layers {
    /// All light.
    pub(crate) whole: Plane,
    /// One bounce.
    pub(crate) indirect: Plane,
}

impl Layers {
    /// Of a picture.
    ///
    /// # Errors
    /// None for a picture of this program.
    pub(crate) fn of(picture: &Picture) -> Result<Self> {
        let plane = |layer: &str| {
            let pixels = picture.rgb(layer).unwrap_or_default();
            Plane::luminance(picture.width, picture.height, &pixels)
        };
        Ok(Self {
            whole: plane("")?,
            indirect: plane("indirect")?,
        })
    }

    /// Errors by layer, side of the blocks and metric. A layer without any reference light, or too small for blocks, is null.
    ///
    /// # Errors
    /// [`crate::exit::Failure::Usage`] for pictures of two sizes.
    pub(crate) fn errors(&self, reference: &Self, sides: &[u32]) -> Result<Value> {
        let layers = [
            ("whole", &self.whole, &reference.whole),
            ("indirect", &self.indirect, &reference.indirect),
        ];
        let mut document = Map::new();
        for (name, test, reference) in layers {
            let mut scales = Map::new();
            for &side in sides {
                scales.insert(side.to_string(), scale(test, reference, side)?);
            }
            document.insert(name.into(), scales.into());
        }
        Ok(document.into())
    }
}

fn scale(test: &Plane, reference: &Plane, side: u32) -> Result<Value> {
    let Some(errors) = compare(test, reference, side)? else {
        return Ok(Value::Null);
    };
    let value = |metric: Metric| (metric.word().to_owned(), errors.get(metric).into());
    let mut document: Map<String, Value> = METRICS.map(value).into_iter().collect();
    document.insert("compared".into(), errors.compared.into());
    document.insert("not_finite".into(), errors.not_finite.into());
    Ok(document.into())
}
