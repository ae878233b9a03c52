//! What the lanes of each column are.

use super::place::Layout;
use crate::data::{Column, Scalar};

/// What neighbouring lanes of a column are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Integers or ids: equal or not. Where they are not, the entry's values are not judged.
    Decision,
    /// As [`Kind::Decision`], and each is the number of an entry of the light columns, whose values are not judged
    /// either if it differs.
    Light,
    /// Numbers whose integer parts are decisions.
    Whole,
    /// Numbers whose binary exponents are decisions.
    Level,
    /// Numbers, each of its own size.
    Numbers,
    /// As [`Kind::Numbers`], over many magnitudes, none of them the difference of larger numbers: small beside their mean
    /// is not small.
    Magnitudes,
    /// One vector or tensor: errors are relative to its largest component.
    Vector,
    /// Points and distances: errors are relative to the column's mean size at least, since they come out of sums of
    /// numbers of that size wherever they lie.
    Points,
}

/// Neighbouring lanes of one kind.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group {
    /// Name for reports; empty if the column is nothing else.
    pub(super) name: &'static str,
    /// Number of lanes.
    pub(super) lanes: usize,
    /// What they are.
    pub(super) kind: Kind,
}

/// What a column holds.
#[derive(Clone, Debug)]
pub(super) struct Meaning {
    /// Order of its entries.
    pub(super) layout: Layout,
    /// Its lanes.
    pub(super) groups: Vec<Group>,
}

type Row = (
    &'static str,
    &'static str,
    Layout,
    &'static [(&'static str, usize, Kind)],
);

/// Sums over a share of the lights. Which lights were drawn, and which are open, are decisions.
#[rustfmt::skip]
const SUMS: &[(&str, usize, Kind)] = &[
    ("diffuse", 3, Kind::Numbers), ("total", 1, Kind::Numbers), ("near", 3, Kind::Numbers), ("open", 1, Kind::Whole),
    ("grazing", 3, Kind::Numbers), ("asked", 1, Kind::Whole),
];

/// Resource, column, order of entries, lanes. A column that is not here is taken as it comes; see [`meaning`].
#[rustfmt::skip]
const TABLE: &[Row] = {
    use Kind::{Decision, Level, Light, Magnitudes, Numbers, Points, Vector, Whole};
    use Layout::{MapTexels, Lights, Maps, Picture, Pyramid, TexelNumbers, Texels};
    &[
        ("gbuffer", "triangle", Picture, &[("", 1, Decision)]),
        ("gbuffer", "position", Picture, &[("position", 3, Points), ("depth", 1, Points)]),
        ("gbuffer", "normal", Picture, &[("normal", 3, Vector), ("f90", 1, Numbers)]),
        ("gbuffer", "diffuse", Picture, &[("albedo", 3, Numbers), ("f0", 1, Numbers)]),
        ("gbuffer", "specular", Picture, &[("f0", 3, Numbers), ("alpha", 1, Magnitudes)]),
        ("gbuffer", "grazing", Picture, &[("", 1, Numbers)]),
        ("gbuffer", "tangent", Picture, &[("tangent", 3, Vector), ("alpha", 1, Magnitudes)]),
        ("gbuffer", "emission", Picture, &[("", 3, Numbers)]),
        ("radiance", "direct", Picture, &[("", 3, Numbers)]),
        ("radiance", "indirect_diffuse", Picture, &[("", 3, Numbers)]),
        ("radiance", "indirect_glossy", Picture, &[("", 3, Numbers)]),
        ("radiance", "sums", Picture, SUMS),
        ("radiance", "emitted", Picture, SUMS),
        ("image", "direct", Picture, &[("", 3, Numbers)]),
        ("image", "indirect_diffuse", Picture, &[("", 3, Numbers)]),
        ("image", "indirect_glossy", Picture, &[("", 3, Numbers)]),
        ("image", "albedo", Picture, &[("", 3, Numbers)]),
        ("image", "normal", Picture, &[("", 3, Vector)]),
        ("image", "depth", Picture, &[("", 1, Points)]),
        ("rsm", "map", Maps, &[
            ("position", 3, Points), ("tan_half_fov", 1, Numbers), ("axis", 3, Vector), ("cos_inner", 1, Numbers),
            ("right", 3, Vector), ("cos_outer", 1, Numbers), ("up", 3, Vector), ("solid_angle", 1, Numbers),
            ("intensity", 3, Numbers), ("kind", 1, Whole), ("cone", 3, Vector), ("inverse_range2", 1, Numbers),
        ]),
        ("rsm", "triangle", Texels, &[("", 1, Decision)]),
        ("rsm", "position", Texels, &[("position", 3, Points), ("area", 1, Magnitudes)]),
        ("rsm", "normal", Texels, &[("normal", 3, Vector), ("f90", 1, Numbers)]),
        ("rsm", "diffuse", Texels, &[("flux", 3, Numbers), ("f0", 1, Numbers)]),
        ("rsm", "specular", Texels, &[("flux", 3, Numbers), ("alpha", 1, Magnitudes)]),
        ("rsm", "grazing", Texels, &[("flux", 3, Numbers), ("luminance", 1, Numbers)]),
        ("rsm", "tangent", Texels, &[("tangent", 3, Vector), ("alpha", 1, Magnitudes)]),
        ("pdf", "weight", Pyramid, &[("", 1, Numbers)]),
        ("pdf", "share", Maps, &[("", 1, Decision)]),
        ("vsgls", "diffuse", Lights, &[
            ("position", 3, Points), ("variance", 1, Magnitudes), ("axis", 3, Vector), ("sharpness", 1, Magnitudes),
            ("intensity", 3, Numbers), ("complement", 1, Magnitudes), ("light", 3, Vector), ("f0", 1, Numbers),
            ("covariance", 6, Vector), ("f90", 1, Numbers), ("bulge", 1, Points),
        ]),
        ("vsgls", "specular", Lights, &[
            ("position", 3, Points), ("variance", 1, Magnitudes), ("axis", 3, Vector), ("complement", 1, Magnitudes),
            ("mirror", 3, Vector), ("complement_mirror", 1, Magnitudes), ("light", 3, Vector),
            ("sharpness_lobe", 1, Magnitudes), ("f0", 3, Numbers), ("alpha", 1, Magnitudes), ("f90", 3, Numbers),
            ("bulge", 1, Points), ("covariance", 6, Vector), ("across", 1, Magnitudes), ("turn", 1, Numbers),
        ]),
        ("vsgls", "target", Lights, &[
            ("position", 3, Points), ("padding", 1, Numbers), ("normal", 3, Vector), ("padding_normal", 1, Numbers),
        ]),
        ("vsgls", "texel", Lights, &[("", 1, Decision)]),
        ("vsgls", "label", TexelNumbers, &[("", 1, Light)]),
        ("occlusion", "depth", MapTexels, &[("", 1, Numbers)]),
        ("vsgls", "kernel", Lights, &[("map", 1, Whole), ("centre", 2, Whole), ("side", 1, Level)]),
    ]
};

/// What a column of a resource holds. Integers of an unknown column are decisions, its floats numbers.
pub(super) fn meaning(resource: &str, column: &Column<'_>) -> Meaning {
    let row = TABLE
        .iter()
        .find(|row| (row.0, row.1) == (resource, column.name));
    let lanes = |row: &&Row| row.3.iter().map(|g| g.1).sum::<usize>();
    let Some(&(_, _, layout, groups)) = row.filter(|row| lanes(row) == column.lanes) else {
        let kind = match column.scalar {
            Scalar::U32 => Kind::Decision,
            Scalar::F32 => Kind::Numbers,
        };
        let group = Group {
            name: "",
            lanes: column.lanes,
            kind,
        };
        return Meaning {
            layout: Layout::Entries,
            groups: vec![group],
        };
    };
    let group = |&(name, lanes, kind): &(&'static str, usize, Kind)| Group { name, lanes, kind };
    Meaning {
        layout,
        groups: groups.iter().map(group).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::{Columns, GBuffer, Image, Occlusion, Pdf, Radiance, Rsm, Vsgls};

    /// Every column of the resource has a row, lanes add up, and integers are decisions.
    fn check<T: Columns + Default>(rows: &mut usize) {
        for column in T::default().columns() {
            let found = meaning(T::NAME, &column);
            let place = (T::NAME, column.name);
            assert_ne!(
                found.layout,
                Layout::Entries,
                "{place:?}: no row, or lanes that do not add up"
            );
            let ids = |g: &Group| matches!(g.kind, Kind::Decision | Kind::Light);
            assert!(
                found
                    .groups
                    .iter()
                    .all(|g| ids(g) == (column.scalar == Scalar::U32)),
                "{place:?}"
            );
            *rows += 1;
        }
    }

    #[test]
    fn every_column_between_phases_has_a_row() {
        let mut rows = 0;
        check::<GBuffer>(&mut rows);
        check::<Radiance>(&mut rows);
        check::<Image>(&mut rows);
        check::<Rsm>(&mut rows);
        check::<Pdf>(&mut rows);
        check::<Vsgls>(&mut rows);
        check::<Occlusion>(&mut rows);
        assert_eq!(rows, TABLE.len(), "rows of columns that are no more");
    }
}
