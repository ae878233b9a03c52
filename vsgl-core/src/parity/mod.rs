//! Whether two backends agree: the same resource from both, column by column, and the whole pipeline phase by phase.
//!
//! Numbers are of two kinds. *Decisions* are discrete: which triangle a ray hit, which cluster a texel fell into. They
//! are equal or not, and where they are not, what follows from them cannot be equal. *Values* are judged only where the
//! decisions that govern them agree, by a [`Tolerance`].
//!
//! | file | holds |
//! | --- | --- |
//! | `tolerance` | how far apart values may be: three tiers with their reasons |
//! | `meaning` | what the lanes of each column are: decisions, vectors, points |
//! | `place` | where an entry lies: column and row of a picture, texel of a map, number of a light |
//! | `ulps` | distance of two floats in representable numbers |
//! | `compare` | two resources of one type |
//! | `column` | one column of both |
//! | `verdict` | what that found |
//! | `chain` | all phases on two backends, each from the reference's input |
//!
//! ```
//! use vsgl_core::data::Radiance;
//! use vsgl_core::parity::{Origin, Side, Tolerance, compare};
//!
//! let reference = Radiance { width: 2, height: 1, direct: vec![[1.0; 3]; 2], ..Radiance::default() };
//! let mut tested = reference.clone();
//! tested.direct[1][2] = f32::from_bits(1.0f32.to_bits() + 1);
//! let cpu = Side { origin: &Origin::new("cpu", "2 threads"), value: &reference };
//! let gpu = Side { origin: &Origin::new("wgpu", "a driver"), value: &tested };
//!
//! let found = compare(&gpu, &cpu, &Tolerance::STRICT, None)?;
//! let direct = found.column("direct").expect("a column of this name");
//! assert!(!found.passed() && direct.differing_components == 1 && direct.ulps == 1);
//! assert_eq!(direct.worst.as_ref().expect("one differs").place.to_string(), "x 1, y 0");
//! assert!(compare(&gpu, &cpu, &Tolerance::SOFTWARE, None)?.passed());
//! // Nothing is proven by comparing a backend with itself.
//! assert!(compare(&cpu, &cpu, &Tolerance::STRICT, None).is_err());
//! # Ok::<(), vsgl_core::Error>(())
//! ```

mod chain;
mod column;
mod compare;
mod meaning;
mod place;
mod tolerance;
mod ulps;
mod verdict;

pub use chain::{Party, Stage, Step, Subject, chain};
pub use compare::{Origin, Side, agreement, compare};
pub use place::Place;
pub use tolerance::{Tolerance, Values};
pub use ulps::ulps;
pub use verdict::{ColumnVerdict, Comparison, DIFFERENT, UNJUDGED, Worst};
