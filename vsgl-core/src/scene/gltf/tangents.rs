//! Tangents for normal maps, where a file has none.
//!
//! Normal maps are baked for the tangents of one algorithm, so this is that algorithm, with the results of the usual
//! library; but without recursion, and in a time that grows with the number of triangles alone: a file chooses how many
//! triangles meet in a point.
//!
//! Source: Morten S. Mikkelsen, 2008, "Simulation of Wrinkled Surfaces Revisited" (thesis, University of Copenhagen),
//! and its reference implementation, with the angular threshold off.

use glam::{DVec2, DVec3, Vec2, Vec3, Vec4};
use std::collections::HashMap;

/// Vertices side by side, and the triangles between them.
pub(super) struct Surface<'a> {
    pub(super) positions: &'a [Vec3],
    /// Of any length; zero: the triangle's own.
    pub(super) normals: &'a [Vec3],
    /// Coordinates in the normal map, v downwards.
    pub(super) texcoords: &'a [Vec2],
    pub(super) triangles: &'a [[u32; 3]],
}

/// No triangle.
const NONE: u32 = u32::MAX;

/// A triangle as the algorithm sees it.
struct Face {
    /// Vertices, each by the first that equals it.
    corners: [u32; 3],
    /// Unit direction of rising u, for a face that is not turned over by its texture coordinates.
    along: DVec3,
    /// Whether the texture coordinates run around as the corners do, v upwards.
    upright: bool,
    /// Without a direction of its own: it takes part in whichever group comes first.
    vague: bool,
    /// Faces beyond the edges from corner 0 to 1, 1 to 2 and 2 to 0.
    neighbours: [u32; 3],
    grouped: [bool; 3],
}

/// Tangents at the corners of each triangle, as glTF has them; zero where the texture coordinates give none.
pub(super) fn tangents(surface: &Surface<'_>) -> Vec<[Vec4; 3]> {
    let mut faces = faces(surface);
    pair(&mut faces);
    let mut tangents = vec![[Vec4::ZERO; 3]; faces.len()];
    let mut members = Vec::new();
    for face in 0..faces.len() {
        for corner in 0..3 {
            let start = &faces[face];
            if start.vague || start.grouped[corner] {
                continue;
            }
            group(&mut faces, face, corner, &mut members);
            let tangent = mean(surface, &faces, &members);
            for &(face, corner) in &members {
                tangents[face as usize][corner] = tangent;
            }
        }
    }
    tangents
}

fn faces(surface: &Surface<'_>) -> Vec<Face> {
    let first = weld(surface);
    let face = |triangle: &[u32; 3]| {
        let corners = triangle.map(|v| first[v as usize]);
        let [p, q, r] = triangle.map(|v| surface.positions[v as usize].as_dvec3());
        let [a, b, c] = triangle.map(|v| upwards(surface.texcoords[v as usize]));
        let (b, c) = (b - a, c - a);
        let area = b.perp_dot(c);
        let along = ((q - p) * c.y - (r - p) * b.y) * area.signum();
        let across = (r - p) * b.x - (q - p) * c.x;
        Face {
            corners,
            along: along.normalize_or_zero(),
            upright: area > 0.0,
            vague: area == 0.0 || along == DVec3::ZERO || across == DVec3::ZERO,
            neighbours: [NONE; 3],
            grouped: [false; 3],
        }
    };
    surface.triangles.iter().map(face).collect()
}

/// glTF's v points down in the image, a bitangent up.
fn upwards(texcoord: Vec2) -> DVec2 {
    DVec2::new(f64::from(texcoord.x), -f64::from(texcoord.y))
}

/// For each vertex the first that has the same position, normal and texture coordinates.
fn weld(surface: &Surface<'_>) -> Vec<u32> {
    let mut known = HashMap::new();
    let vertices = 0..surface.positions.len() as u32;
    let first = |vertex: u32| {
        let v = vertex as usize;
        let (p, n, t) = (
            surface.positions[v],
            surface.normals[v],
            surface.texcoords[v],
        );
        // Adding zero makes one of both zeros.
        let key = [p.x, p.y, p.z, n.x, n.y, n.z, t.x, t.y].map(|c| (c + 0.0).to_bits());
        *known.entry(key).or_insert(vertex)
    };
    vertices.map(first).collect()
}

/// Makes neighbours of faces that run along an edge in opposite directions: the first with the first, and so on.
fn pair(faces: &mut [Face]) {
    let mut edges = Vec::with_capacity(3 * faces.len());
    for (f, face) in faces.iter().enumerate() {
        let [a, b, c] = face.corners;
        if a == b || b == c || c == a {
            continue;
        }
        for (edge, (from, to)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
            edges.push((from.min(to), from.max(to), from < to, f as u32, edge));
        }
    }
    edges.sort_unstable();
    for shared in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let turn = shared.partition_point(|edge| !edge.2);
        let (back, forth) = shared.split_at(turn);
        for (&(.., f, f_edge), &(.., g, g_edge)) in back.iter().zip(forth) {
            faces[f as usize].neighbours[f_edge] = g;
            faces[g as usize].neighbours[g_edge] = f;
        }
    }
}

/// Gathers into `members` the faces around a corner that are joined by edges and turned over alike.
fn group(faces: &mut [Face], face: usize, corner: usize, members: &mut Vec<(u32, usize)>) {
    let vertex = faces[face].corners[corner];
    let upright = faces[face].upright;
    members.clear();
    let mut waiting = vec![face as u32];
    while let Some(index) = waiting.pop() {
        let face = &mut faces[index as usize];
        let Some(corner) = face.corners.iter().position(|&c| c == vertex) else {
            continue;
        };
        if face.grouped[corner] {
            continue;
        }
        if face.vague && face.grouped == [false; 3] {
            face.upright = upright;
        }
        if face.upright != upright {
            continue;
        }
        face.grouped[corner] = true;
        members.push((index, corner));
        let beside = [corner, (corner + 2) % 3].map(|edge| face.neighbours[edge]);
        waiting.extend(beside.into_iter().filter(|&f| f != NONE));
    }
}

/// The mean of the faces' directions in the plane of the normal, weighted by their angles.
fn mean(surface: &Surface<'_>, faces: &[Face], members: &[(u32, usize)]) -> Vec4 {
    let mut sum = DVec3::ZERO;
    for &(face, corner) in members {
        let shape = &faces[face as usize];
        if shape.vague {
            continue;
        }
        let triangle = surface.triangles[face as usize];
        let turned = [0, 2, 1].map(|step| triangle[(corner + step) % 3] as usize);
        let [here, before, after] = turned.map(|v| surface.positions[v].as_dvec3());
        let given = surface.normals[turned[0]].as_dvec3().normalize_or_zero();
        let normal = match given == DVec3::ZERO {
            true => (after - here).cross(before - here).normalize_or_zero(),
            false => given,
        };
        let flat = |v: DVec3| (v - normal * normal.dot(v)).normalize_or_zero();
        let cosine = flat(before - here).dot(flat(after - here));
        sum += flat(shape.along) * cosine.clamp(-1.0, 1.0).acos();
    }
    let upright = members
        .first()
        .is_some_and(|&(face, _)| faces[face as usize].upright);
    // In f64 first: a small sum has few digits in f32.
    let tangent = sum.normalize_or_zero().as_vec3();
    match tangent == Vec3::ZERO {
        true => Vec4::ZERO,
        false => tangent.extend(if upright { 1.0 } else { -1.0 }),
    }
}

/// Gives each vertex one tangent: those whose corners have several are doubled. Returns the tangents of the vertices and
/// of the doubles after them, and the vertices that these double; `triangles` use them.
pub(super) fn split(
    vertices: usize,
    triangles: &mut [[u32; 3]],
    corners: &[[Vec4; 3]],
) -> (Vec<Vec4>, Vec<u32>) {
    let mut tangents: Vec<Option<Vec4>> = vec![None; vertices];
    let mut doubled = Vec::new();
    let mut more = Vec::new();
    let mut known: HashMap<(u32, [u32; 4]), u32> = HashMap::new();
    let used = triangles.as_flattened_mut().iter_mut();
    for (vertex, &tangent) in used.zip(corners.as_flattened()) {
        let own = tangents[*vertex as usize].get_or_insert(tangent);
        if *own == tangent {
            continue;
        }
        let key = (*vertex, tangent.to_array().map(f32::to_bits));
        *vertex = *known.entry(key).or_insert_with(|| {
            doubled.push(*vertex);
            more.push(tangent);
            (vertices + doubled.len() - 1) as u32
        });
    }
    let own = tangents.into_iter().map(Option::unwrap_or_default);
    (own.chain(more).collect(), doubled)
}

#[cfg(test)]
mod tests {
    use super::*;
    use bevy_mikktspace::{Geometry, TangentSpace, generate_tangents};
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    /// The library that everybody uses, as the model of ours.
    struct Library<'a>(&'a Surface<'a>, Vec<[Vec4; 3]>);

    impl Library<'_> {
        fn vertex(&self, face: usize, corner: usize) -> usize {
            self.0.triangles[face][corner] as usize
        }
    }

    impl Geometry for Library<'_> {
        fn num_faces(&self) -> usize {
            self.0.triangles.len()
        }
        fn num_vertices_of_face(&self, _: usize) -> usize {
            3
        }
        fn position(&self, face: usize, corner: usize) -> [f32; 3] {
            self.0.positions[self.vertex(face, corner)].to_array()
        }
        fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
            self.0.normals[self.vertex(face, corner)].to_array()
        }
        fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
            let Vec2 { x, y } = self.0.texcoords[self.vertex(face, corner)];
            [x, -y]
        }
        fn set_tangent(&mut self, tangent: Option<TangentSpace>, face: usize, corner: usize) {
            self.1[face][corner] = tangent.map_or(Vec4::ZERO, |t| t.tangent_encoded().into());
        }
    }

    fn library(surface: &Surface<'_>) -> Vec<[Vec4; 3]> {
        let mut library = Library(surface, vec![[Vec4::ZERO; 3]; surface.triangles.len()]);
        generate_tangents(&mut library).unwrap();
        library.1
    }

    #[test]
    fn an_upright_image_has_tangents_to_the_right() {
        let positions = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y];
        let texcoords = [Vec2::Y, Vec2::ONE, Vec2::X, Vec2::ZERO];
        let mirrored = texcoords.map(|t| Vec2::new(1.0 - t.x, t.y));
        let triangles = [[0, 1, 2], [0, 2, 3]];
        for (texcoords, expected) in [
            (texcoords, Vec4::new(1.0, 0.0, 0.0, 1.0)),
            (mirrored, Vec4::new(-1.0, 0.0, 0.0, -1.0)),
        ] {
            for normals in [[Vec3::Z; 4], [Vec3::ZERO; 4]] {
                let surface = Surface {
                    positions: &positions,
                    normals: &normals,
                    texcoords: &texcoords,
                    triangles: &triangles,
                };
                assert_eq!(tangents(&surface), [[expected; 3]; 2]);
            }
        }
    }

    #[test]
    fn a_million_triangles_about_one_point_take_no_stack_and_no_time() {
        let count = 1_000_000u32;
        let angle = |i: u32| std::f32::consts::TAU * i as f32 / count as f32;
        let rim = (0..count).map(|i| Vec3::new(angle(i).cos(), angle(i).sin(), 0.0));
        let positions: Vec<_> = [Vec3::ZERO].into_iter().chain(rim).collect();
        let texcoords: Vec<_> = positions.iter().map(|p| Vec2::new(p.x, -p.y)).collect();
        let triangles: Vec<_> = (0..count)
            .map(|i| [0, i + 1, (i + 1) % count + 1])
            .collect();
        let surface = Surface {
            positions: &positions,
            normals: &vec![Vec3::Z; positions.len()],
            texcoords: &texcoords,
            triangles: &triangles,
        };
        let found = tangents(&surface);
        assert!(found[0][0].distance(Vec4::new(1.0, 0.0, 0.0, 1.0)) < 1e-4);
    }

    #[test]
    fn vertices_with_several_tangents_are_doubled() {
        let mut triangles = [[0, 1, 2], [0, 2, 1], [0, 1, 2]];
        let corners = [
            [Vec4::X; 3],
            [Vec4::Y, Vec4::X, Vec4::X],
            [Vec4::Y, Vec4::X, Vec4::Z],
        ];
        let (tangents, doubled) = split(4, &mut triangles, &corners);
        assert_eq!(triangles, [[0, 1, 2], [4, 2, 1], [4, 1, 5]]);
        assert_eq!(doubled, [0, 2]);
        assert_eq!(
            tangents,
            [Vec4::X, Vec4::X, Vec4::X, Vec4::ZERO, Vec4::Y, Vec4::Z]
        );
    }

    /// Twelve vertices from five places, three normals and four texture coordinates, so that many coincide.
    fn vertices() -> impl Strategy<Value = Vec<(Vec3, Vec3, Vec2)>> {
        let number = || -1f32..1.0;
        let point = || [number(), number(), number()].prop_map(Vec3::from);
        let places = prop::collection::vec(point(), 5);
        let normals = prop::collection::vec(point().prop_map(|n| n.normalize_or(Vec3::X)), 3);
        let texcoords = prop::collection::vec([number(), number()].prop_map(Vec2::from), 4);
        let choice = prop::collection::vec((0usize..5, 0usize..3, 0usize..4), 12);
        (places, normals, texcoords, choice).prop_map(|(places, normals, texcoords, choice)| {
            let vertex = |(p, n, t): (usize, usize, usize)| (places[p], normals[n], texcoords[t]);
            choice.into_iter().map(vertex).collect()
        })
    }

    proptest! {
        // Always the same cases: once in millions of corners directions are so nearly opposite that f32 sees no difference,
        // and the library keeps them apart.
        #![proptest_config(ProptestConfig {
            cases: 2000,
            failure_persistence: None,
            rng_seed: RngSeed::Fixed(1),
            ..ProptestConfig::default()
        })]

        #[test]
        fn the_library_finds_the_same(
            vertices in vertices(),
            triangles in prop::collection::vec([0u32..12, 0..12, 0..12], 1..40),
        ) {
            let positions: Vec<_> = vertices.iter().map(|v| v.0).collect();
            let normals: Vec<_> = vertices.iter().map(|v| v.1).collect();
            let texcoords: Vec<_> = vertices.iter().map(|v| v.2).collect();
            let different = |t: &[u32; 3]| {
                let [a, b, c] = t.map(|v| positions[v as usize]);
                a != b && b != c && c != a
            };
            let triangles: Vec<_> = triangles.into_iter().filter(different).collect();
            let surface = Surface {
                positions: &positions,
                normals: &normals,
                texcoords: &texcoords,
                triangles: &triangles,
            };
            let (ours, theirs) = (tangents(&surface), library(&surface));
            for (ours, theirs) in ours.as_flattened().iter().zip(theirs.as_flattened()) {
                prop_assert!(ours.distance(*theirs) < 1e-3, "{ours} {theirs}");
            }
        }

        #[test]
        fn whatever_the_numbers_tangents_are_unit_or_zero(
            numbers in prop::collection::vec(prop::num::f32::NORMAL | prop::num::f32::ZERO | prop::num::f32::SUBNORMAL, 8 * 6),
            triangles in prop::collection::vec([0u32..6, 0..6, 0..6], 1..20),
        ) {
            let vertices = || numbers.chunks_exact(8);
            let surface = Surface {
                positions: &vertices().map(|n| Vec3::new(n[0], n[1], n[2])).collect::<Vec<_>>(),
                normals: &vertices().map(|n| Vec3::new(n[3], n[4], n[5])).collect::<Vec<_>>(),
                texcoords: &vertices().map(|n| Vec2::new(n[6], n[7])).collect::<Vec<_>>(),
                triangles: &triangles,
            };
            for tangent in tangents(&surface).as_flattened() {
                prop_assert!(*tangent == Vec4::ZERO || tangent.truncate().is_normalized(), "{tangent}");
            }
        }
    }
}
