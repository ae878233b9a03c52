//! One reflective shadow map as pictures.

use crate::output::exposure::automatic;
use crate::output::font::Canvas;
use crate::output::tonemap::Tonemap;
use crate::output::{color, srgb};
use crate::picture::{Channel, Picture};
use vsgl_core::data::{NO_TRIANGLE, Pdf, Rsm, Vsgls};
use vsgl_core::metrics::luminance;

/// Pictures have at least so many pixels along a side: small maps are enlarged by a whole factor.
const SIDE: usize = 512;

/// A map with what belongs to it.
pub(super) struct Map<'a> {
    /// Texels along a side.
    pub(super) size: usize,
    /// Which map it is.
    pub(super) index: u32,
    /// Pixels of a picture along a side of a texel.
    pub(super) zoom: usize,
    rsm: &'a Rsm,
    weights: Option<Vec<f32>>,
    /// Cluster of each texel of this map; empty if they have none.
    pub(super) labels: &'a [u32],
}

impl<'a> Map<'a> {
    pub(super) fn new(
        rsm: &'a Rsm,
        pdf: Option<&'a Pdf>,
        vsgls: Option<&'a Vsgls>,
        index: u32,
    ) -> Self {
        let size = rsm.size as usize;
        let range = index as usize * size * size..(index as usize + 1) * size * size;
        Self {
            size,
            index,
            zoom: SIDE.div_ceil(size),
            rsm,
            weights: pdf.map(|pdf| weights(pdf, size, index as usize)),
            labels: vsgls.and_then(|v| v.label.get(range)).unwrap_or_default(),
        }
    }

    /// Index of the first texel in the columns of the RSM.
    pub(super) fn first(&self) -> usize {
        self.index as usize * self.size * self.size
    }

    /// Reflected flux of each texel \[W\]: Lambert and specular part.
    pub(super) fn flux(&self) -> Vec<[f32; 3]> {
        let specular = |i: usize| self.rsm.specular.get(i).copied().unwrap_or_default();
        let sum = |i: usize| {
            let (d, s) = (self.rsm.diffuse[i], specular(i));
            [d[0] + s[0], d[1] + s[1], d[2] + s[2]]
        };
        self.texels().map(sum).collect()
    }

    fn texels(&self) -> std::ops::Range<usize> {
        self.first()..self.first() + self.size * self.size
    }

    fn hit(&self, texel: usize) -> bool {
        self.rsm.triangle[texel] != NO_TRIANGLE
    }

    /// A picture with a colour for each texel.
    pub(super) fn canvas(&self, color: impl Fn(usize) -> [u8; 3]) -> Canvas {
        let side = self.size * self.zoom;
        let mut canvas = Canvas::new(side, side, [0; 3]);
        for y in 0..side {
            for x in 0..side {
                canvas.set(x, y, color(y / self.zoom * self.size + x / self.zoom));
            }
        }
        canvas
    }

    /// Positions: red, green and blue from the least to the greatest x, y and z of this map.
    pub(super) fn positions(&self) -> Canvas {
        let position = |i: usize| self.rsm.position[i];
        let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for texel in self.texels().filter(|&i| self.hit(i)) {
            for lane in 0..3 {
                low[lane] = low[lane].min(position(texel)[lane]);
                high[lane] = high[lane].max(position(texel)[lane]);
            }
        }
        self.canvas(|i| {
            let texel = self.first() + i;
            if !self.hit(texel) {
                return [0; 3];
            }
            let share = |lane: usize| {
                let width = (high[lane] - low[lane]).max(f32::MIN_POSITIVE);
                (position(texel)[lane] - low[lane]) / width
            };
            [0, 1, 2].map(|lane| (255.0 * share(lane)) as u8)
        })
    }

    /// Normals: -1 is 0, 1 is 255.
    pub(super) fn normals(&self) -> Canvas {
        self.canvas(|i| {
            let texel = self.first() + i;
            let normal = self.rsm.normal[texel];
            if !self.hit(texel) {
                return [0; 3];
            }
            [0, 1, 2].map(|lane| (127.5 * normal[lane] + 128.0) as u8)
        })
    }

    /// Fluxes, exposed and tone-mapped like a picture.
    pub(super) fn fluxes(&self) -> Canvas {
        let flux = self.flux();
        let scale = automatic(&flux).exp2();
        self.canvas(|i| {
            Tonemap::Neutral
                .apply(flux[i].map(|c| c * scale))
                .map(srgb::code)
        })
    }

    /// Brightness of each texel for drawings over the map, 0..=1: the flux as the eye sees it.
    pub(super) fn brightness(&self) -> Vec<f32> {
        let flux = self.flux();
        let scale = automatic(&flux).exp2();
        let gray = |p: &[f32; 3]| srgb::encode((luminance(*p) as f32 * scale).min(1.0));
        flux.iter().map(gray).collect()
    }

    /// The density on a logarithmic scale over four decades below its greatest value.
    pub(super) fn densities(&self) -> Option<Canvas> {
        let weights = self.weights.as_deref()?;
        let greatest = weights.iter().copied().fold(f32::MIN_POSITIVE, f32::max);
        Some(self.canvas(|i| {
            if weights[i] <= 0.0 {
                return [0; 3];
            }
            color::scale(1.0 + (weights[i] / greatest).log10() / 4.0)
        }))
    }

    /// All columns with the texels' clusters, for an EXR.
    pub(super) fn picture(&self) -> Picture {
        let lanes = |column: &[[f32; 4]]| -> Vec<[f32; 3]> {
            let texels = self.texels().filter_map(|i| column.get(i));
            texels.map(|v| [v[0], v[1], v[2]]).collect()
        };
        let size = self.size as u32;
        let mut picture = Picture::from_rgb(size, size, &self.flux());
        picture.push("diffuse.", ["R", "G", "B"], &lanes(&self.rsm.diffuse));
        if !self.rsm.specular.is_empty() {
            picture.push("specular.", ["R", "G", "B"], &lanes(&self.rsm.specular));
            let alpha = self.texels().map(|i| self.rsm.specular[i][3]);
            picture.channels.push(channel("alpha.Y", alpha.collect()));
        }
        picture.push("P.", ["X", "Y", "Z"], &lanes(&self.rsm.position));
        picture.push("N.", ["X", "Y", "Z"], &lanes(&self.rsm.normal));
        let area = self.texels().map(|i| self.rsm.position[i][3]);
        picture.channels.push(channel("area.Y", area.collect()));
        if let Some(weights) = &self.weights {
            picture.channels.push(channel("pdf.Y", weights.clone()));
        }
        if !self.labels.is_empty() {
            // Small integers are exact in f32; none is -1.
            let label = |&l: &u32| if l == u32::MAX { -1.0 } else { l as f32 };
            let labels = self.labels.iter().map(label).collect();
            picture.channels.push(channel("cluster.Y", labels));
        }
        picture
    }
}

/// Weights of the texels of one map; the density is padded to a power of two.
fn weights(pdf: &Pdf, size: usize, index: usize) -> Vec<f32> {
    let padded = pdf.size as usize;
    let place = |y: usize, x: usize| (index * padded + y) * padded + x;
    let texels = (0..size).flat_map(|y| (0..size).map(move |x| (y, x)));
    let weight = |(y, x)| pdf.weight.get(place(y, x)).copied().unwrap_or_default();
    texels.map(weight).collect()
}

fn channel(name: &str, values: Vec<f32>) -> Channel {
    Channel {
        name: name.into(),
        values,
    }
}
