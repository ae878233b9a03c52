//! A picture with named channels, as it lies in an EXR file.

use vsgl_core::data::Image;

/// Linear channels of one size, row-major from the top left.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// The channels; each has `width * height` values.
    pub channels: Vec<Channel>,
}

/// One channel of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Name as in EXR files: `R`, or `layer.R`.
    pub name: String,
    /// The values.
    pub values: Vec<f32>,
}

impl Picture {
    /// All layers of a rendered picture.
    pub fn from_image(image: &Image) -> Self {
        let mut picture = Self {
            width: image.width,
            height: image.height,
            channels: Vec::new(),
        };
        picture.push("", ["R", "G", "B"], &image.beauty());
        picture.push("direct.", ["R", "G", "B"], &image.direct);
        picture.push("indirect.", ["R", "G", "B"], &image.indirect());
        picture.push(
            "indirect_diffuse.",
            ["R", "G", "B"],
            &image.indirect_diffuse,
        );
        picture.push("indirect_glossy.", ["R", "G", "B"], &image.indirect_glossy);
        picture.push("albedo.", ["R", "G", "B"], &image.albedo);
        picture.push("N.", ["X", "Y", "Z"], &image.normal);
        picture.channels.push(Channel {
            name: "Z".into(),
            values: image.depth.clone(),
        });
        picture
    }

    /// The rendered picture with these layers; none if one is missing.
    pub fn to_image(&self) -> Option<Image> {
        let [x, y, z] = ["N.X", "N.Y", "N.Z"].map(|name| self.channel(name));
        let normal = x?.iter().zip(y?).zip(z?);
        Some(Image {
            width: self.width,
            height: self.height,
            direct: self.rgb("direct")?,
            indirect_diffuse: self.rgb("indirect_diffuse")?,
            indirect_glossy: self.rgb("indirect_glossy")?,
            albedo: self.rgb("albedo")?,
            normal: normal.map(|((&x, &y), &z)| [x, y, z]).collect(),
            depth: self.channel("Z")?.to_vec(),
        })
    }

    /// A picture of one colour layer.
    pub fn from_rgb(width: u32, height: u32, pixels: &[[f32; 3]]) -> Self {
        let mut picture = Self {
            width,
            height,
            channels: Vec::new(),
        };
        picture.push("", ["R", "G", "B"], pixels);
        picture
    }

    /// Appends three channels.
    pub fn push(&mut self, prefix: &str, names: [&str; 3], pixels: &[[f32; 3]]) {
        for (lane, name) in names.into_iter().enumerate() {
            self.channels.push(Channel {
                name: format!("{prefix}{name}"),
                values: pixels.iter().map(|p| p[lane]).collect(),
            });
        }
    }

    /// The values of the channel of this name.
    pub fn channel(&self, name: &str) -> Option<&[f32]> {
        let channel = self.channels.iter().find(|c| c.name == name)?;
        Some(&channel.values)
    }

    /// The colours of a layer; the layer `""` is `R`, `G`, `B`. A layer of one channel is grey.
    pub fn rgb(&self, layer: &str) -> Option<Vec<[f32; 3]>> {
        let name = |channel: &str| match layer {
            "" => channel.to_owned(),
            _ => format!("{layer}.{channel}"),
        };
        let colours = ["R", "G", "B"].map(|c| self.channel(&name(c)));
        if let [Some(r), Some(g), Some(b)] = colours {
            let pixels = r.iter().zip(g).zip(b);
            return Some(pixels.map(|((&r, &g), &b)| [r, g, b]).collect());
        }
        // With an X beside it, Y is a coordinate.
        let luma = self
            .channel(&name("Y"))
            .filter(|_| self.channel(&name("X")).is_none());
        let grey = luma.or_else(|| self.channel(layer))?;
        Some(grey.iter().map(|&v| [v; 3]).collect())
    }

    /// Names of the layers that [`Picture::rgb`] knows, for messages.
    pub fn layers(&self) -> Vec<String> {
        let mut layers: Vec<String> = Vec::new();
        for channel in &self.channels {
            let layer = match channel.name.rsplit_once('.') {
                Some((layer, _)) => layer,
                None if ["R", "G", "B", "A", "Y"].contains(&channel.name.as_str()) => "",
                None => &channel.name,
            };
            if self.rgb(layer).is_some() && !layers.iter().any(|l| l == layer) {
                layers.push(layer.to_owned());
            }
        }
        layers
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_are_found_by_prefix() {
        let mut picture = Picture::from_rgb(1, 1, &[[1.0, 2.0, 3.0]]);
        picture.push("indirect.", ["R", "G", "B"], &[[4.0, 5.0, 6.0]]);
        picture.push("N.", ["X", "Y", "Z"], &[[0.0, 0.5, 0.0]]);
        picture.channels.push(Channel {
            name: "Z".into(),
            values: vec![7.0],
        });
        assert_eq!(picture.rgb(""), Some(vec![[1.0, 2.0, 3.0]]));
        assert_eq!(picture.rgb("indirect"), Some(vec![[4.0, 5.0, 6.0]]));
        assert_eq!(picture.rgb("Z"), Some(vec![[7.0; 3]]));
        assert_eq!(picture.rgb("direct"), None);
        assert_eq!(picture.rgb("N"), None);
        assert!(picture.layers().contains(&"indirect".to_owned()));
    }
}
