//! Runs of small triangles: what one draw of a shadow map stands for, and where a map needs the triangles themselves.
//!
//! Triangles are numbered in the order of the hierarchy, so that those between two draws are neighbours. One disc for all of them
//! is right where a map sees them within a texel; nearer it closes the gaps between them, and there each is drawn as what it is.
//!
//! Source: after Holländer, Ritschel, Eisemann and Boubekeur 2011, "ManyLoDs: Parallel Many-View Level-of-Detail Selection for
//! Real-Time Global Illumination" (each view takes of the scene what it sees apart), with two levels instead of a hierarchy.

use super::occlusion::MapFrame;
use super::splat::find;
use glam::Vec3;

/// Triangles of a run that are drawn, at most: of more every second, every third …, and those stand for all.
pub const RUN_MAX: u32 = 128;
/// Draws that fall on a triangle of no run, at least.
pub const DRAWS: u32 = 4;
/// Runs whose box has a larger radius are drawn triangle by triangle; in distances over texels along a side. A texel is as wide
/// as 2.5 of this unit.
pub const APART: f32 = 0.6;

/// Small triangles, one after the other.
#[derive(Clone, Copy, Debug, Default)]
pub struct Run {
    /// Middle of their box \[m\].
    pub centre: Vec3,
    /// Half its diagonal \[m\].
    pub radius: f32,
    /// The first of them.
    pub first: u32,
    /// How many are drawn.
    pub count: u32,
    /// Every which of them.
    pub every: u32,
}

/// Whether draws fall on a triangle with these shares before it and with it so often that it is in no run.
#[inline(always)]
pub fn wide(low: u32, high: u32, stride: u32) -> bool {
    (high - low) / DRAWS >= stride
}

/// The run of a triangle that is not [`wide`]: that of the draw whose step holds the beginning of its share.
#[inline(always)]
pub fn of(low: u32, stride: u32, points: u32) -> u32 {
    (low / stride).min(points.max(1) - 1)
}

/// First triangle of a run.
#[inline(always)]
pub fn first(share: &[u32], index: u32, stride: u32) -> u32 {
    let before = (index * stride).max(1) - 1;
    let found = (find(share, before) + 1).min(share.len() as u32);
    if index == 0 { 0 } else { found }
}

impl Run {
    /// The run of a draw, of `points` at distances of `stride`.
    pub fn new(share: &[u32], corner: &[[f32; 9]], index: u32, points: u32, stride: u32) -> Self {
        let begin = first(share, index, stride);
        let mut end = share.len() as u32;
        if index + 1 < points {
            end = first(share, index + 1, stride);
        }
        // What is wide reaches beyond the run's shares: only the last can be.
        if end > begin {
            let low = if end > 1 { share[end as usize - 2] } else { 0 };
            if wide(low, share[end as usize - 1], stride) {
                end -= 1;
            }
        }
        let all = end.max(begin) - begin;
        let every = all.div_ceil(RUN_MAX).max(1);
        let count = all.div_ceil(every);
        let (mut least, mut most) = (Vec3::MAX, Vec3::MIN);
        for i in 0..count {
            let c = &corner[(begin + i * every) as usize];
            let (a, b, c) = (
                Vec3::new(c[0], c[1], c[2]),
                Vec3::new(c[3], c[4], c[5]),
                Vec3::new(c[6], c[7], c[8]),
            );
            least = least.min(a.min(b).min(c));
            most = most.max(a.max(b).max(c));
        }
        let half = if count > 0 {
            (most - least) * 0.5
        } else {
            Vec3::ZERO
        };
        Self {
            centre: if count > 0 { least + half } else { Vec3::ZERO },
            radius: half.dot(half).sqrt(),
            first: begin,
            count,
            every,
        }
    }

    /// Whether a map draws its triangles; otherwise draws that fall on them stand for them.
    #[inline(always)]
    pub fn is_apart(&self, frame: &MapFrame, side: u32) -> bool {
        let seen = frame.local(self.centre);
        let distance = seen.dot(seen).sqrt();
        let near = self.radius * side as f32 > APART * distance;
        (self.count > 0) & near & (seen.z + self.radius > 0.0)
    }
}
