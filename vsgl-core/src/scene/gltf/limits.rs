//! How much a file may ask for.

use crate::error::{Error, Result};

/// One struct from one list, so that names, meanings and defaults are written once.
macro_rules! limits {
    ($( $name:ident = $default:expr, $about:literal; )*) => {
        /// What is read at most. The defaults keep the memory for a hostile file below a gigabyte; raise them for scenes
        /// that need more.
        ///
        /// How deep nodes are nested is not limited: they are walked without recursion. JSON itself may be nested 127
        /// deep.
        #[derive(Clone, Debug, PartialEq, Eq)]
        pub struct Limits {
            $(
                #[doc = concat!($about, ". Default: ", stringify!($default), ".")]
                pub $name: u64,
            )*
        }

        impl Default for Limits {
            fn default() -> Self {
                Self { $( $name: $default, )* }
            }
        }

        impl Limits {
            /// Names, in the order of the fields, each with its meaning.
            pub const NAMES: &'static [(&'static str, &'static str)] = &[$( (stringify!($name), $about) ),*];

            /// Names with values, in the same order.
            pub fn entries(&self) -> Vec<(&'static str, u64)> {
                vec![$( (stringify!($name), self.$name) ),*]
            }

            fn slot(&mut self, name: &str) -> Option<&mut u64> {
                match name {
                    $( stringify!($name) => Some(&mut self.$name), )*
                    _ => None,
                }
            }
        }
    };
}

limits! {
    file_bytes = 256 << 20, "bytes of all files of the scene together";
    json_bytes = 96 << 20, "bytes of JSON, data inside addresses counted";
    objects = 1 << 18, "JSON objects: nodes, meshes, accessors and so on are one each";
    triangles = 5 << 18, "triangles drawn, instances counted";
    vertices = 1 << 22, "vertices drawn, instances counted; triangles without normals have three each";
    displacements = 1 << 23, "displacements by morph targets with a weight: one for each vertex and target";
    joints = 1 << 16, "joints of all skins in use";
    lights = 1024, "lights";
    overlap = 2048, "triangles in one place, each of which a ray there would test";
    memory = 768 << 20, "bytes that the scene takes while it is prepared to be drawn";
    texels = 1 << 26, "texels of all images that materials use; those of 16 bits count twice";
}

impl Limits {
    /// Sets a limit by its name.
    ///
    /// # Errors
    /// [`Error::Setting`] for an unknown name or a value that is not a whole number.
    pub fn set(&mut self, name: &str, value: &str) -> Result<()> {
        let Some(slot) = self.slot(name) else {
            let names: Vec<_> = Self::NAMES.iter().map(|&(name, _)| name).collect();
            let remedy = format!("give one of {}", names.join(", "));
            return Err(Error::setting(name, "is no limit", remedy));
        };
        *slot = value.parse().map_err(|_| {
            let problem = format!("`{value}` is no whole number");
            Error::setting(name, problem, "give one from 0 to 18446744073709551615")
        })?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_limit_is_set_by_its_name() {
        let mut limits = Limits::default();
        for (i, (name, about)) in Limits::NAMES.iter().enumerate() {
            limits.set(name, &i.to_string()).unwrap();
            assert!(!about.is_empty());
        }
        for (i, (name, value)) in limits.entries().into_iter().enumerate() {
            assert_eq!((name, value), (Limits::NAMES[i].0, i as u64));
        }
        for (name, value) in [
            ("texel", "1"),
            ("texels", "-1"),
            ("texels", "many"),
            ("", ""),
        ] {
            assert!(limits.set(name, value).is_err(), "{name}={value}");
        }
    }
}
