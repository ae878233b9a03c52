//! What a user chooses: one plain struct with flat keys, the same on the command line, in files and in reports.

use crate::error::{Error, Result};
use std::fmt;

/// Everything that decides how a picture is made; the scene and the view are not in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// How indirect light is found.
    pub method: Method,
    /// Number of clusters, that is of virtual spherical Gaussian lights: 1 ..= [`Settings::LIGHTS_MAX`].
    pub lights: u32,
    /// Texels along a side of each reflective shadow map: 1 ..= [`Settings::RSM_MAX`].
    pub rsm: u32,
    /// How texels become clusters.
    pub clustering: Clustering,
    /// Density from which cluster centres are drawn, for clusterings that sample.
    pub pdf: PdfMethod,
    /// Virtual lights made from what the camera sees, for the density `brsm`: 1 ..= [`Settings::LIGHTS_MAX`].
    pub camera_lights: u32,
    /// Overlap of filtered kernels: each holds `kernel / lights` of the density. Above 1 steadies and blurs.
    pub kernel: f32,
    /// Steps of the bisection for the size of filtered kernels.
    pub bisections: u32,
    /// Shape of the light that a cluster sends.
    pub emission: Emission,
    /// From the mean length of directions to a sharpness.
    pub sharpness: SharpnessFit,
    /// Which variance stands for a cluster's extent.
    pub variance: Variance,
    /// Integral of an incoming lobe against the receiver's Lambert part.
    pub diffuse: DiffuseForm,
    /// Integral of an incoming lobe against the receiver's specular part.
    pub glossy: GlossyForm,
    /// Whether and how indirect light is blocked.
    pub occlusion: OcclusionMethod,
    /// Rays from each sample with `occlusion` = `sampled`: 1 ..= 64.
    pub rays: u32,
    /// Side of the square of samples that share out the virtual lights: 1, 2, 4 or 8; 1 gives every sample all of them.
    pub interleave: u32,
    /// Texels along a side of each imperfect shadow map: [`Settings::MAP_MIN`] ..= [`Settings::MAP_MAX`].
    pub map_size: u32,
    /// Points of each imperfect shadow map: 1 ..= [`Settings::POINTS_MAX`].
    pub map_points: u32,
    /// What decides which triangle the camera sees.
    pub primary: Primary,
    /// Paths through each pixel, with the method `path`: 1 ..= [`Settings::SPP_MAX`].
    pub spp: u32,
    /// Longest paths, with the method `path`: 1 light that surfaces send by themselves, 2 direct light, 3 one bounce, up to
    /// [`Settings::DEPTH_MAX`].
    pub max_depth: u32,
    /// Which of the lights, and of the surfaces that shine, a path asks for their light, with the method `path`.
    pub light_sampling: LightSampling,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            method: Method::Vsgl,
            lights: 1024,
            rsm: 512,
            clustering: Clustering::Partition,
            pdf: PdfMethod::Flux,
            camera_lights: 2048,
            kernel: 1.0,
            bisections: 12,
            emission: Emission::Cosine,
            sharpness: SharpnessFit::Banerjee,
            variance: Variance::PerAxis,
            diffuse: DiffuseForm::V13,
            glossy: GlossyForm::NdfFilter,
            occlusion: OcclusionMethod::Rays,
            rays: 8,
            interleave: 1,
            map_size: 64,
            map_points: 8192,
            primary: Primary::Rays,
            spp: 64,
            max_depth: 3,
            light_sampling: LightSampling::Power,
        }
    }
}

/// An enumeration of settings' values with their spelling.
macro_rules! choice {
    ($(#[$meta:meta])* pub enum $type:ident { $( $(#[$vmeta:meta])* $variant:ident = $word:literal ),* $(,)? }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $type { $( $(#[$vmeta])* $variant ),* }

        impl $type {
            /// All values, in the order of the documentation.
            pub const ALL: &'static [Self] = &[$( Self::$variant ),*];
            /// Their spellings, in the same order.
            pub const WORDS: &'static [&'static str] = &[$( $word ),*];

            /// Spelling on the command line.
            pub fn word(self) -> &'static str {
                match self { $( Self::$variant => $word ),* }
            }

            /// The value with this spelling.
            pub fn from_word(word: &str) -> Option<Self> {
                match word { $( $word => Some(Self::$variant), )* _ => None }
            }
        }

        impl fmt::Display for $type {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(self.word())
            }
        }
    };
}

choice! {
    /// How indirect light is found.
    pub enum Method {
        /// Clusters shaded by closed-form integrals.
        Vsgl = "vsgl",
        /// Every texel of the reflective shadow maps a point light: the limit of infinitely many clusters, slow.
        Vpl = "vpl",
        /// Paths of light drawn at random from the eye, without error but noise: the truth to compare with.
        Path = "path",
    }
}
choice! {
    /// How texels become clusters.
    pub enum Clustering {
        /// Every texel in exactly one cluster: greedy best-first binary partition.
        Partition = "partition",
        /// Modified filtered importance sampling with trilinear kernels (Tokuyoshi 2016).
        Filtered = "filtered",
        /// The same centres with square kernels that hold just their share of the density.
        FilteredBox = "filtered-box",
        /// Filtered importance sampling as it was: a kernel's size from the density at its centre (Křivánek and Colbert 2008;
        /// Tokuyoshi 2015).
        FilteredOriginal = "filtered-original",
        /// The same centres; every texel in the cluster of the one that is nearest in space.
        NearestWorld = "nearest-world",
        /// One cluster for each map, all of its texels: two lights in all under one spot (Tokuyoshi 2015). No sampling, no
        /// partition, and the number of lights is ignored.
        Whole = "whole",
    }
}
impl Clustering {
    /// Whether it draws cluster centres from a density.
    pub fn draws(self) -> bool {
        !matches!(self, Self::Partition | Self::Whole)
    }

    /// Whether clusters are kernels, which overlap; else every texel belongs to one cluster.
    pub fn has_kernels(self) -> bool {
        matches!(
            self,
            Self::Filtered | Self::FilteredBox | Self::FilteredOriginal
        )
    }
}
choice! {
    /// Density on the texels.
    pub enum PdfMethod {
        /// Equal on all texels that reflect light.
        Uniform = "uniform",
        /// Luminance of the reflected flux.
        Flux = "flux",
        /// That of the flux that matters to what the camera sees (bidirectional reflective shadow maps, Ritschel et al. 2011).
        Brsm = "brsm",
    }
}
choice! {
    /// Shape of the light that a cluster sends.
    pub enum Emission {
        /// Clamped cosine averaged over normals, and GGX under the light's lobe: what the surface really sends.
        Cosine = "cosine",
        /// One spherical Gaussian for each part (Tokuyoshi 2015, 2016). Both lie at their common mean position, as in the paper
        /// of 2016; with the clustering `whole` each at its own, as in that of two lights.
        Sg = "sg",
    }
}
choice! {
    /// From the mean length of directions to a sharpness.
    pub enum SharpnessFit {
        /// Banerjee et al. 2005; the Lambert lobe has sharpness 2.2925.
        Banerjee = "banerjee",
        /// Toksvig 2005, as in the papers of 2015 and 2016; the Lambert lobe has sharpness 2.
        Toksvig = "toksvig",
    }
}
choice! {
    /// Which variance stands for a cluster's extent.
    pub enum Variance {
        /// Variance along one axis in the surface: half the trace of the covariance.
        PerAxis = "per-axis",
        /// The whole trace, as printed in the papers of 2015 and 2016: a footprint √2 too wide.
        Trace = "trace",
    }
}
choice! {
    /// Integral of a spherical Gaussian against the clamped cosine.
    pub enum DiffuseForm {
        /// Our refit of the 2024 form, error 1.2e-4 of the peak.
        V13 = "v13",
        /// As `v13` with one term more, error 4.5e-5.
        V14 = "v14",
        /// Tokuyoshi et al. 2024, error 1.5e-3.
        Tokuyoshi2024 = "2024",
        /// Difference of two hemispherical integrals (Tokuyoshi 2022), error 4.2e-3.
        Tokuyoshi2022 = "2022",
        /// The same by the integral of Meder and Brüderlin 2018, error 1.5e-2.
        MederBruederlin2018 = "2018",
        /// The cosine as a spherical Gaussian, with the inner product of sharp lobes (Tokuyoshi 2015, two lights), error 0.15.
        Sg2015 = "sg-2015",
        /// The cosine as a spherical Gaussian, with the exact inner product, error 0.14.
        SgProduct = "sg-product",
        /// The cosine at the lobe's axis (Tokuyoshi 2016).
        Constant = "constant",
    }
}
choice! {
    /// Integral of a spherical Gaussian against the specular part.
    pub enum GlossyForm {
        /// NDF filtering (Tokuyoshi et al. 2024) with the masking ratio that it lacks.
        NdfFilter = "ndf-filter",
        /// NDF filtering as published.
        NdfFilter2024 = "ndf-filter-2024",
        /// Anisotropic spherical Gaussian (Xu et al. 2013), the rest of the reflectance at the light's axis (Tokuyoshi 2016).
        Asg2013 = "asg-2013",
        /// The same with the rest of the reflectance at the axis of the integrand (Tokuyoshi 2015, two lights).
        Asg2015 = "asg-2015",
        /// Isotropic spherical Gaussian (Wang et al. 2009; Tokuyoshi 2015, two lights, equation 2).
        Sg = "sg",
        /// NDF filtering with the shape of a blurred GGX, and wide lights by the albedo: closest to the exact integrals, though
        /// not in pictures.
        Blend = "blend",
    }
}
choice! {
    /// Whether and how indirect light is blocked.
    pub enum OcclusionMethod {
        /// Not at all: light passes through walls.
        None = "none",
        /// One ray from each pixel to a real point of each cluster.
        Rays = "rays",
        /// A few rays from each pixel, to clusters chosen by what they bring to the eye; the share of open ones, taken together
        /// over neighbours, times the light without shadows.
        Sampled = "sampled",
        /// Imperfect shadow maps of random points (Ritschel et al. 2008): a small map for each cluster.
        Ism = "ism",
        /// Imperfect shadow maps of triangles cut into pieces (Barak et al. 2013, Tokuyoshi 2016).
        IsmTessellated = "ism-tessellated",
    }
}

impl OcclusionMethod {
    /// Whether shadow maps decide.
    pub fn has_maps(self) -> bool {
        matches!(self, Self::Ism | Self::IsmTessellated)
    }
}

choice! {
    /// Which of the lights, and of the surfaces that shine, a path asks for their light.
    pub enum LightSampling {
        /// By the luminance of the flux that they send, and a tenth of the draws evenly.
        Power = "power",
        /// Each with the same chance.
        Uniform = "uniform",
    }
}
choice! {
    /// What decides which triangle the camera sees.
    pub enum Primary {
        /// A ray through each sample: the definition, on every backend.
        Rays = "rays",
        /// The GPU's rasteriser: faster on many GPUs, and another triangle here and there along edges. The backend wgpu
        /// alone has it.
        Raster = "raster",
    }
}
choice! {
    /// Named settings.
    pub enum Preset {
        /// The forms of this library: [`Settings::default`].
        Default = "default",
        /// 64 lights, shared out among 4 × 4 pixels: a frame of 640 × 360 pixels takes 0.4 to 1.2 s of processor time and has an error
        /// of 7 to 18 % in four scenes, and of 30 % in Sponza.
        ///
        /// This and the next two are points of the measured front of these scenes, but for the latter two in Sponza, where
        /// `occlusion = sampled` is better (`docs/sweep.md`, which has the commands). Errors are those of the indirect light in
        /// blocks of 8 × 8 pixels, the noise of the reference, 2 to 4 %, included.
        Fast = "fast",
        /// 1024 lights, shared out likewise: 1.7 to 5.2 s, 4.6 to 6.4 % and 16 %; a twelfth of the time of [`Preset::Default`].
        Balanced = "balanced",
        /// 4096 lights, shared out likewise: 6 to 19 s, 4.5 to 5.5 % and 13 %.
        Accurate = "accurate",
        /// The published configuration of Tokuyoshi 2016, for comparison; its error does not fall with more lights.
        Paper2016 = "paper-2016",
        /// The published configuration of Tokuyoshi 2015, "Fast Indirect Illumination Using Two Virtual Spherical Gaussian
        /// Lights": two lights for a whole map, for comparison.
        Paper2015 = "paper-2015",
    }
}

impl GlossyForm {
    /// Whether the form knows surfaces with two roughnesses. The others take them for surfaces with the roughness across the
    /// tangent.
    pub fn two_roughnesses(self) -> bool {
        !matches!(self, Self::Sg | Self::Blend)
    }
}

/// So many lights, shared out among 4 × 4 pixels.
fn shared(lights: u32) -> Settings {
    Settings {
        lights,
        interleave: 4,
        ..Settings::default()
    }
}

impl Preset {
    /// The settings that the preset stands for.
    pub fn settings(self) -> Settings {
        match self {
            Self::Default => Settings::default(),
            Self::Fast => shared(64),
            Self::Balanced => shared(1024),
            Self::Accurate => shared(4096),
            Self::Paper2016 => Settings {
                clustering: Clustering::Filtered,
                emission: Emission::Sg,
                sharpness: SharpnessFit::Toksvig,
                variance: Variance::Trace,
                diffuse: DiffuseForm::Constant,
                glossy: GlossyForm::Asg2013,
                ..Settings::default()
            },
            Self::Paper2015 => Settings {
                rsm: 128,
                clustering: Clustering::Whole,
                emission: Emission::Sg,
                sharpness: SharpnessFit::Toksvig,
                variance: Variance::Trace,
                diffuse: DiffuseForm::Sg2015,
                glossy: GlossyForm::Asg2015,
                occlusion: OcclusionMethod::None,
                ..Settings::default()
            },
        }
    }
}

impl Settings {
    /// Most clusters.
    pub const LIGHTS_MAX: u32 = 65_536;
    /// Largest side of a reflective shadow map.
    pub const RSM_MAX: u32 = 4096;
    /// Most rays from a sample.
    pub const RAYS_MAX: u32 = 64;
    /// Most paths through a pixel.
    pub const SPP_MAX: u32 = 1 << 24;
    /// Longest paths.
    pub const DEPTH_MAX: u32 = 64;
    /// Smallest side of an imperfect shadow map.
    pub const MAP_MIN: u32 = 8;
    /// Largest side of an imperfect shadow map.
    pub const MAP_MAX: u32 = 256;
    /// Most points of an imperfect shadow map.
    pub const POINTS_MAX: u32 = 65_536;
    /// All keys, in the order of [`Settings::entries`].
    pub const KEYS: &'static [&'static str] = &[
        "method",
        "lights",
        "rsm",
        "clustering",
        "pdf",
        "camera_lights",
        "kernel",
        "bisections",
        "emission",
        "sharpness",
        "variance",
        "diffuse",
        "glossy",
        "occlusion",
        "rays",
        "interleave",
        "map_size",
        "map_points",
        "primary",
        "spp",
        "max_depth",
        "light_sampling",
    ];

    /// All keys with their values, as [`Settings::set`] takes them.
    pub fn entries(&self) -> Vec<(&'static str, String)> {
        let values = [
            self.method.to_string(),
            self.lights.to_string(),
            self.rsm.to_string(),
            self.clustering.to_string(),
            self.pdf.to_string(),
            self.camera_lights.to_string(),
            self.kernel.to_string(),
            self.bisections.to_string(),
            self.emission.to_string(),
            self.sharpness.to_string(),
            self.variance.to_string(),
            self.diffuse.to_string(),
            self.glossy.to_string(),
            self.occlusion.to_string(),
            self.rays.to_string(),
            self.interleave.to_string(),
            self.map_size.to_string(),
            self.map_points.to_string(),
            self.primary.to_string(),
            self.spp.to_string(),
            self.max_depth.to_string(),
            self.light_sampling.to_string(),
        ];
        Self::KEYS.iter().copied().zip(values).collect()
    }

    /// Sets one key.
    ///
    /// # Errors
    /// [`Error::Setting`] for an unknown key or a value outside its range; the settings are unchanged then.
    pub fn set(&mut self, key: &str, value: &str) -> Result<()> {
        match key {
            "method" => self.method = word(key, value, Method::from_word, Method::WORDS)?,
            "lights" => self.lights = integer(key, value, 1, Self::LIGHTS_MAX)?,
            "rsm" => self.rsm = integer(key, value, 1, Self::RSM_MAX)?,
            "clustering" => {
                self.clustering = word(key, value, Clustering::from_word, Clustering::WORDS)?
            }
            "pdf" => self.pdf = word(key, value, PdfMethod::from_word, PdfMethod::WORDS)?,
            "camera_lights" => self.camera_lights = integer(key, value, 1, Self::LIGHTS_MAX)?,
            "kernel" => self.kernel = number(key, value, 1e-3, 1e6)?,
            "bisections" => self.bisections = integer(key, value, 1, 64)?,
            "emission" => self.emission = word(key, value, Emission::from_word, Emission::WORDS)?,
            "sharpness" => {
                self.sharpness = word(key, value, SharpnessFit::from_word, SharpnessFit::WORDS)?
            }
            "variance" => self.variance = word(key, value, Variance::from_word, Variance::WORDS)?,
            "diffuse" => {
                self.diffuse = word(key, value, DiffuseForm::from_word, DiffuseForm::WORDS)?
            }
            "glossy" => self.glossy = word(key, value, GlossyForm::from_word, GlossyForm::WORDS)?,
            "occlusion" => {
                self.occlusion = word(
                    key,
                    value,
                    OcclusionMethod::from_word,
                    OcclusionMethod::WORDS,
                )?
            }
            "rays" => self.rays = integer(key, value, 1, Self::RAYS_MAX)?,
            "interleave" => self.interleave = side(key, value)?,
            "map_size" => self.map_size = integer(key, value, Self::MAP_MIN, Self::MAP_MAX)?,
            "map_points" => self.map_points = integer(key, value, 1, Self::POINTS_MAX)?,
            "primary" => self.primary = word(key, value, Primary::from_word, Primary::WORDS)?,
            "spp" => self.spp = integer(key, value, 1, Self::SPP_MAX)?,
            "max_depth" => self.max_depth = integer(key, value, 1, Self::DEPTH_MAX)?,
            "light_sampling" => {
                self.light_sampling =
                    word(key, value, LightSampling::from_word, LightSampling::WORDS)?
            }
            _ => {
                let remedy = format!("keys are {}", Self::KEYS.join(", "));
                return Err(Error::setting(key, "no such key", remedy));
            }
        }
        Ok(())
    }
}

fn word<T>(key: &str, value: &str, parse: fn(&str) -> Option<T>, words: &[&str]) -> Result<T> {
    parse(value).ok_or_else(|| {
        Error::setting(
            key,
            format!("no value `{value}`"),
            format!("values are {}", words.join(", ")),
        )
    })
}

fn integer(key: &str, value: &str, least: u32, most: u32) -> Result<u32> {
    let fits = value.parse().ok().filter(|n| (least..=most).contains(n));
    fits.ok_or_else(|| {
        Error::setting(
            key,
            format!("`{value}` does not fit"),
            format!("give a whole number from {least} to {most}"),
        )
    })
}

/// A side of [`Settings::interleave`].
fn side(key: &str, value: &str) -> Result<u32> {
    let fits = value.parse().ok().filter(|n| [1, 2, 4, 8].contains(n));
    fits.ok_or_else(|| Error::setting(key, format!("`{value}` does not fit"), "give 1, 2, 4 or 8"))
}

fn number(key: &str, value: &str, least: f32, most: f32) -> Result<f32> {
    let fits = value.parse().ok().filter(|n| (least..=most).contains(n));
    fits.ok_or_else(|| {
        Error::setting(
            key,
            format!("`{value}` does not fit"),
            format!("give a number from {least} to {most}"),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_round_trip_and_bad_values_change_nothing() {
        let mut settings = Settings::default();
        for (key, value) in Preset::Paper2016.settings().entries() {
            settings.set(key, &value).expect("own entries are accepted");
        }
        assert_eq!(settings, Preset::Paper2016.settings());
        for (key, value) in [
            ("lights", "0"),
            ("kernel", "NaN"),
            ("glossy", "x"),
            ("nokey", "1"),
            ("rsm", "1e3"),
            ("interleave", "3"),
            ("rays", "65"),
        ] {
            assert!(settings.set(key, value).is_err(), "{key}={value}");
        }
        assert_eq!(settings, Preset::Paper2016.settings());
    }

    #[test]
    fn every_preset_is_what_its_entries_say() {
        for preset in Preset::ALL {
            let mut settings = Settings::default();
            for (key, value) in preset.settings().entries() {
                settings.set(key, &value).expect("own entries are accepted");
            }
            assert_eq!(settings, preset.settings(), "{preset}");
        }
    }
}
