//! Decisions with their reasons, and sizes that are smaller than wanted.

use super::{OcclusionPlan, Reason, RsmPlan};
use crate::settings::{OcclusionMethod, Settings};

/// The decisions so far.
#[derive(Default)]
pub(super) struct Reasons(pub(super) Vec<Reason>);

impl Reasons {
    /// Runs only if every condition holds; the first that does not is the reason.
    pub(super) fn decide(
        &mut self,
        topic: &'static str,
        needs: &[(bool, &str)],
        because: &str,
    ) -> bool {
        let missing = needs.iter().find(|(holds, _)| !holds);
        let why = missing.map_or(because, |(_, why)| why).to_owned();
        self.0.push(Reason {
            topic,
            runs: missing.is_none(),
            why,
        });
        missing.is_none()
    }

    /// Texels along a side of a map: as wanted, but halved until all maps together are within [`RsmPlan::TEXELS_MAX`].
    /// One map is as large as wanted; a map of emitters alone has no more texels than they have points.
    pub(super) fn map_size(&mut self, of_lights: u32, emitters: bool, wanted: u32) -> u32 {
        let maps = of_lights.saturating_add(u32::from(emitters));
        if of_lights == 0 && wanted > RsmPlan::EMITTERS_SIDE {
            let side = RsmPlan::EMITTERS_SIDE;
            self.0.push(Reason {
                topic: "smaller maps",
                runs: true,
                why: format!("surfaces that shine have {side}² points in all"),
            });
            return side;
        }
        let texels = |side: u32| u64::from(maps) * u64::from(side) * u64::from(side);
        let mut side = wanted;
        while maps > 1 && side > 1 && texels(side) > RsmPlan::TEXELS_MAX {
            side /= 2;
        }
        let why = if side == wanted {
            format!("{maps} of {side}² texels, as wanted")
        } else {
            let most = RsmPlan::TEXELS_MAX;
            format!("{maps} of {wanted}² texels would have more than {most} in all: {side}² each")
        };
        self.0.push(Reason {
            topic: "smaller maps",
            runs: side != wanted,
            why,
        });
        side
    }

    /// Side of the square of samples that share out the lights: as wanted, but halved until every share has a light.
    pub(super) fn interleave(&mut self, wanted: u32, lights: u32) -> u32 {
        let mut side = wanted;
        while side > 1 && side * side > lights {
            side /= 2;
        }
        let why = match (wanted, side) {
            (1, _) => "every sample takes every virtual light".to_owned(),
            _ if side < wanted => {
                format!("{lights} lights are fewer than {wanted}x{wanted} shares")
            }
            _ => format!("each sample of {side}x{side} takes its share of the virtual lights"),
        };
        self.0.push(Reason {
            topic: "interleaved shading",
            runs: side > 1,
            why,
        });
        side
    }

    /// Sides and points of the shadow maps: as wanted, but halved until all of them together are few enough.
    pub(super) fn shadow_maps(
        &mut self,
        settings: &Settings,
        count: u32,
        masks: bool,
    ) -> OcclusionPlan {
        let maps = u64::from(count);
        let texels = |side: u32| maps * u64::from(side) * u64::from(side);
        let (mut side, mut points) = (settings.map_size, settings.map_points);
        while side > Settings::MAP_MIN && texels(side) > OcclusionPlan::TEXELS_MAX {
            side = (side / 2).max(Settings::MAP_MIN);
        }
        while points > 1 && maps * u64::from(points) > OcclusionPlan::POINTS_MAX {
            points /= 2;
        }
        let (wanted, of) = (settings.map_size, settings.map_points);
        let why = if (side, points) == (wanted, of) {
            format!("{maps} of {side}² texels and {points} points, as wanted")
        } else {
            format!(
                "{maps} of {wanted}² texels and {of} points would have more than {} or {} in all: {side}² and {points} each",
                OcclusionPlan::TEXELS_MAX,
                OcclusionPlan::POINTS_MAX
            )
        };
        self.0.push(Reason {
            topic: "smaller shadow maps",
            runs: (side, points) != (wanted, of),
            why,
        });
        OcclusionPlan {
            side,
            points,
            tessellated: settings.occlusion == OcclusionMethod::IsmTessellated,
            masks,
        }
    }

    pub(super) fn no(&mut self, topic: &'static str, why: &str) {
        self.0.push(Reason {
            topic,
            runs: false,
            why: why.to_owned(),
        });
    }
}
