//! Arguments that choose how light is computed. Core's settings know which values there are.

use clap::Args;
use clap::builder::PossibleValuesParser;
use std::path::PathBuf;
use vsgl_core::settings::{
    Clustering, DiffuseForm, Emission, GlossyForm, LightSampling, Method, OcclusionMethod,
    PdfMethod, Preset, Primary, Settings,
};

/// Preset, file, keys and flags; each overrides those before it.
#[derive(Args, Clone, Debug, Default, PartialEq)]
#[command(next_help_heading = "Settings (preset, then file, then --set, then the other flags)")]
pub struct SettingsArgs {
    /// Named settings to start from; `vsgl info` lists them
    #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(Preset::WORDS))]
    pub preset: Option<String>,
    /// File with a line `key = value` for each setting; # begins a comment
    #[arg(long = "settings", value_name = "FILE")]
    pub file: Option<PathBuf>,
    /// Set any setting by its key (repeatable); `vsgl info` lists the keys
    #[arg(long, value_name = "KEY=VALUE", value_parser = key_value)]
    pub set: Vec<(String, String)>,
    /// How indirect light is found; vpl takes every texel for a light, path draws paths of light: slow, to compare with
    #[arg(long, value_parser = PossibleValuesParser::new(Method::WORDS))]
    pub method: Option<String>,
    /// Number of virtual lights [default: 1024]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub lights: Option<String>,
    /// Texels along a side of each reflective shadow map [default: 512]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub rsm: Option<String>,
    /// Overlap of filtered kernels [default: 1]
    #[arg(long, value_name = "K", allow_hyphen_values = true)]
    pub kernel: Option<String>,
    /// Density that kernels are drawn from, if any are: equal, by flux, or by what of it matters to the camera [default: flux]
    #[arg(long, value_parser = PossibleValuesParser::new(PdfMethod::WORDS))]
    pub pdf: Option<String>,
    /// Shape of the light that a virtual light sends
    #[arg(long, value_parser = PossibleValuesParser::new(Emission::WORDS))]
    pub emission: Option<String>,
    /// How texels become virtual lights
    #[arg(long, value_parser = PossibleValuesParser::new(Clustering::WORDS))]
    pub clustering: Option<String>,
    /// Whether and how indirect light is blocked: not, by a ray to each light, by a few rays (--set rays=8), or by shadow maps
    /// of points or of pieces of triangles [default: rays]
    #[arg(long, value_parser = PossibleValuesParser::new(OcclusionMethod::WORDS))]
    pub occlusion: Option<String>,
    /// Side of the square of pixels that share out the virtual lights: 1, 2, 4 or 8 [default: 1]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub interleave: Option<String>,
    /// Integral over the receiver's Lambert part
    #[arg(long, value_parser = PossibleValuesParser::new(DiffuseForm::WORDS))]
    pub diffuse: Option<String>,
    /// Integral over the receiver's specular part
    #[arg(long, value_parser = PossibleValuesParser::new(GlossyForm::WORDS))]
    pub glossy: Option<String>,
    /// What decides which triangle the camera sees; raster needs the backend wgpu, and differs along edges [default: rays]
    #[arg(long, value_parser = PossibleValuesParser::new(Primary::WORDS))]
    pub primary: Option<String>,
    /// Paths through each pixel, with --method path [default: 64]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub spp: Option<String>,
    /// Longest paths, with --method path: 1 light that surfaces send by themselves, 2 direct light, 3 one bounce, up to 64
    /// [default: 3]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub max_depth: Option<String>,
    /// Which lights paths ask, with --method path: by the power that they send, or each with the same chance [default: power]
    #[arg(long, value_parser = PossibleValuesParser::new(LightSampling::WORDS))]
    pub light_sampling: Option<String>,
}

impl SettingsArgs {
    /// Keys of core's settings that have a flag of the same name.
    pub const FLAGS: [&'static str; 15] = [
        "method",
        "lights",
        "rsm",
        "kernel",
        "pdf",
        "emission",
        "clustering",
        "occlusion",
        "interleave",
        "diffuse",
        "glossy",
        "primary",
        "spp",
        "max_depth",
        "light_sampling",
    ];

    /// Whether somebody chose the value of this key: by a flag, by `--set`, or by a preset or a file that differ from the usual.
    pub fn chooses(&self, settings: &Settings, key: &str) -> bool {
        let usual = Settings::default().entries();
        let differs =
            |(entry, usual): (&(&str, String), &(&str, String))| entry.0 == key && entry != usual;
        self.flags().any(|(k, _)| k == key)
            || self.set.iter().any(|(k, _)| k == key)
            || settings.entries().iter().zip(&usual).any(differs)
    }

    /// The flags with their values, in the order of [`SettingsArgs::FLAGS`].
    pub fn flags(&self) -> impl Iterator<Item = (&'static str, &str)> {
        let values = [
            &self.method,
            &self.lights,
            &self.rsm,
            &self.kernel,
            &self.pdf,
            &self.emission,
            &self.clustering,
            &self.occlusion,
            &self.interleave,
            &self.diffuse,
            &self.glossy,
            &self.primary,
            &self.spp,
            &self.max_depth,
            &self.light_sampling,
        ];
        let pairs = Self::FLAGS.into_iter().zip(values);
        pairs.filter_map(|(key, value)| Some((key, value.as_deref()?)))
    }
}

/// Reads `KEY=VALUE`.
///
/// # Errors
/// What would be accepted.
pub(super) fn key_value(word: &str) -> Result<(String, String), String> {
    let (key, value) = word
        .split_once('=')
        .ok_or("give a name and a value with = between them, such as lights=4096")?;
    Ok((key.trim().to_owned(), value.trim().to_owned()))
}
