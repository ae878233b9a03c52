//! What brings the vertices of a mesh to the world: a node, copies of it, joints.

use super::instancing::Copies;
use super::primitive::Primitive;
use super::skins::Influences;
use glam::{DMat3, DMat4, DVec3, Vec3, Vec4};

/// What brings the vertices of a primitive to the world.
pub(super) enum Frames<'a> {
    /// The node.
    One(&'a DMat4),
    /// The node, and each of the copies before it. Made one by one: there may be as many as triangles.
    Many(&'a DMat4, &'a Copies<'a>),
    /// Joints, vertex by vertex.
    Bent(&'a [DMat4], &'a Influences),
}

impl Frames<'_> {
    pub(super) fn len(&self) -> usize {
        match self {
            Self::One(_) | Self::Bent(..) => 1,
            Self::Many(_, copies) => copies.len(),
        }
    }

    /// The frame of copy `index`.
    pub(super) fn frame(&self, index: usize) -> Frame<'_> {
        match self {
            Self::One(world) => Frame::Rigid(**world),
            Self::Many(world, copies) => Frame::Rigid(**world * copies.local(index)),
            Self::Bent(joints, influences) => Frame::Bent(joints, influences),
        }
    }
}

/// What brings the vertices of one copy to the world.
pub(super) enum Frame<'a> {
    Rigid(DMat4),
    Bent(&'a [DMat4], &'a Influences),
}

impl Frame<'_> {
    pub(super) fn at(&self, vertex: usize) -> DMat4 {
        match self {
            Self::Rigid(world) => *world,
            Self::Bent(joints, influences) => influences.blend(vertex, joints),
        }
    }

    pub(super) fn positions(&self, primitive: &Primitive) -> impl Iterator<Item = DVec3> {
        let positions = primitive.positions.iter().enumerate();
        positions.map(|(v, p)| self.at(v).transform_point3(p.as_dvec3()))
    }
}

/// What turns directions at each vertex.
pub(super) enum Turn<'a> {
    Rigid(Directions),
    Bent(&'a Frame<'a>),
}

impl<'a> Turn<'a> {
    pub(super) fn of(frame: &'a Frame<'a>) -> Self {
        match frame {
            Frame::Rigid(world) => Self::Rigid(Directions::of(world)),
            Frame::Bent(..) => Self::Bent(frame),
        }
    }

    pub(super) fn at(&self, vertex: usize) -> Directions {
        match self {
            Self::Rigid(directions) => *directions,
            Self::Bent(frame) => Directions::of(&frame.at(vertex)),
        }
    }
}

/// What turns directions when a matrix moves points.
#[derive(Clone, Copy)]
pub(super) struct Directions {
    /// What the matrix does to differences of points.
    linear: DMat3,
    /// The matrix of cofactors is the inverse transpose times the determinant, and exists where the inverse does not.
    cofactors: DMat3,
    /// Whether left and right change sides.
    pub(super) mirrored: bool,
}

impl Directions {
    pub(super) fn of(world: &DMat4) -> Self {
        let (x, y, z) = (
            world.x_axis.truncate(),
            world.y_axis.truncate(),
            world.z_axis.truncate(),
        );
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
        let mirrored = x.dot(y.cross(z)) < 0.0;
        Self {
            linear: DMat3::from_cols(x, y, z),
            cofactors: if mirrored { -cofactors } else { cofactors },
            mirrored,
        }
    }

    /// A normal of any length, turned, of length 1; zero if it points nowhere.
    pub(super) fn normal(&self, normal: Vec3) -> Vec3 {
        let turned = (self.cofactors * normal.as_dvec3()).try_normalize();
        turned.map_or(Vec3::ZERO, |n| n.as_vec3().normalize_or_zero())
    }

    /// A tangent, turned, of length 1; its bitangent changes sides in a mirror. Zero if it points nowhere.
    pub(super) fn tangent(&self, tangent: Vec4) -> Vec4 {
        let turned = (self.linear * tangent.truncate().as_dvec3()).try_normalize();
        let sign = if self.mirrored { -tangent.w } else { tangent.w };
        turned.map_or(Vec4::ZERO, |t| t.as_vec3().normalize_or_zero().extend(sign))
    }
}
