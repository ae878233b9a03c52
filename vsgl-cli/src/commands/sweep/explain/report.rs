//! The split, for people and for machines.

use super::chain::{Chain, Link};
use super::points::BLOCK;
use crate::exit::Result;
use crate::text::json_number;
use serde_json::{Value, json};
use vsgl_core::explain::{Part, Picture, Yardstick};

/// A chain with its parts measured, over pixels and over blocks.
pub(super) struct Measured<'a> {
    pub(super) chain: &'a Chain,
    /// The pixels of the grid.
    pub(super) grid: Yardstick,
    blocks: Option<Yardstick>,
}

/// Parts over pixels and over blocks; none where nothing is left to compare.
#[derive(Clone, Copy)]
pub(super) struct Scales {
    pub(super) pixel: Option<Part>,
    pub(super) block: Option<Part>,
}

impl<'a> Measured<'a> {
    /// Measures.
    ///
    /// # Errors
    /// None for a chain of this program.
    pub(super) fn new(chain: &'a Chain) -> Result<Self> {
        let points = &chain.points;
        let of = |width, height, range: &dyn Fn(&Picture) -> Picture| {
            Yardstick::new(width, height, &range(&chain.truth), &range(&chain.tested))
        };
        let (width, height) = points.grid;
        let grid = of(width, height, &|p| single(chain, p))?;
        let blocks = (points.blocks > 0)
            .then(|| of(points.blocks * BLOCK, BLOCK, &|p| blocked(chain, p)))
            .transpose()?;
        Ok(Self {
            chain,
            grid,
            blocks,
        })
    }

    /// How much of the error a difference is.
    pub(super) fn scales(&self, step: &Picture) -> Scales {
        let pixel = self.grid.part(&single(self.chain, step), 1);
        let block = match &self.blocks {
            Some(blocks) => blocks.part(&blocked(self.chain, step), BLOCK),
            None => self.grid.part(step, BLOCK),
        };
        Scales { pixel, block }
    }

    /// The whole error.
    pub(super) fn whole(&self) -> Scales {
        self.scales(&self.chain.tested.minus(&self.chain.truth))
    }
}

/// The pixels of the grid.
fn single(chain: &Chain, picture: &Picture) -> Picture {
    let count = chain.points.singles();
    Picture {
        halves: picture.halves.clone().map(|h| h[..count].to_vec()),
    }
}

/// The pixels of the blocks.
fn blocked(chain: &Chain, picture: &Picture) -> Picture {
    let count = chain.points.singles();
    Picture {
        halves: picture.halves.clone().map(|h| h[count..].to_vec()),
    }
}

fn part_json(part: Option<Part>) -> Value {
    part.map_or(Value::Null, |p| {
        json!({
            "bias": json_number(p.bias),
            "mape": json_number(p.mape),
            "rmspe": json_number(p.rmspe),
            "share": json_number(p.share),
            "noise": json_number(p.noise),
        })
    })
}

fn scales_json(scales: Scales) -> Value {
    json!({"pixel": part_json(scales.pixel), "block": part_json(scales.block)})
}

/// Name of the picture of a link.
pub(super) fn picture_name(link: &Link) -> String {
    format!("explain/{}.png", link.cause.word())
}

/// The split as `explain.json` has it, without what the settings were.
pub(super) fn document(measured: &Measured<'_>) -> Value {
    let chain = measured.chain;
    let points = &chain.points;
    let link = |link: &Link| {
        let mut value = scales_json(measured.scales(&link.step));
        value["cause"] = link.cause.word().into();
        value["title"] = link.cause.title().into();
        value["from"] = link.from.as_str().into();
        value["to"] = link.to.as_str().into();
        value["runs"] = link.none.is_none().into();
        value["why"] = link.none.into();
        let other = link.other.as_ref();
        value["other_order"] = other.map_or(Value::Null, |step| scales_json(measured.scales(step)));
        value["picture"] = match link.none {
            None => picture_name(link).into(),
            Some(_) => Value::Null,
        };
        value
    };
    let lights = match &chain.lights {
        Ok(lights) => json!({
            "given": lights.count[0],
            "more": lights.count[1],
            "error_given": scales_json(measured.scales(&lights.step[0])),
            "error_more": scales_json(measured.scales(&lights.step[1])),
            "why": null,
        }),
        Err(why) => json!({
            "given": null, "more": null, "error_given": null, "error_more": null, "why": why,
        }),
    };
    json!({
        "kind": "explain",
        "points": {
            "grid": [points.grid.0, points.grid.1],
            "whole_picture": points.blocks == 0,
            "blocks": points.blocks,
            "block_side": BLOCK,
            "pixels": points.pixels.len(),
        },
        "reference": {"source": "path", "spp": chain.paths},
        "rsm": chain.rsm,
        "whole": scales_json(measured.whole()),
        "links": chain.links.iter().map(link).collect::<Vec<_>>(),
        "lights": lights,
        "pictures": {
            "tested": "explain/tested.png",
            "truth": "explain/truth.png",
            "whole": "explain/whole.png",
        },
    })
}

/// Names of the columns of a scale.
const COLUMNS: [&str; 5] = ["bias", "mape", "rmspe", "share", "noise"];

/// The table that people read.
pub(super) fn text(document: &Value) -> String {
    let points = &document["points"];
    let mut out = String::from("indirect light, percent of the truth\n");
    let pixels = if points["whole_picture"] == true {
        "all pixels; blocks of 8x8".to_owned()
    } else {
        let grid = &points["grid"];
        format!(
            "{}x{} pixels of the picture; {} blocks of 8x8",
            grid[0], grid[1], points["blocks"]
        )
    };
    out += &format!("{pixels}\n\n{:<33}", "");
    out += &format!("{:^35} {:>24}\n", "pixels", "blocks of 8x8");
    let head: String = COLUMNS.iter().map(|c| format!("{c:>7}")).collect();
    out += &format!("{:<33}{head} {head}\n", "cause");
    let row = |name: &str, value: &Value| {
        let cells = |part: &Value| -> String { COLUMNS.iter().map(|c| cell(&part[*c])).collect() };
        let line = format!(
            "{name:<33}{} {}",
            cells(&value["pixel"]),
            cells(&value["block"])
        );
        line.trim_end().to_owned() + "\n"
    };
    let links = document["links"].as_array().cloned().unwrap_or_default();
    for link in &links {
        let title = link["title"].as_str().unwrap_or_default();
        match link["why"].as_str() {
            Some(why) => out += &format!("{title:<33}      0  {why}\n"),
            None => out += &row(title, link),
        }
    }
    out += &row("whole error", &document["whole"]);
    let others: Vec<_> = links
        .iter()
        .filter(|l| !l["other_order"].is_null())
        .collect();
    if !others.is_empty() {
        out += "\nvisibility after emission and integral\n";
        for link in others {
            let title = link["title"].as_str().unwrap_or_default();
            out += &row(title, &link["other_order"]);
        }
    }
    let lights = &document["lights"];
    out += "\nclusters against their texels, outside the chain\n";
    match lights["why"].as_str() {
        Some(why) => out += &format!("{why}\n"),
        None => {
            for (count, error) in [("given", "error_given"), ("more", "error_more")] {
                let name = format!("{} virtual lights", lights[count]);
                out += &row(&name, &lights[error]);
            }
        }
    }
    out
}

fn cell(value: &Value) -> String {
    match value.as_f64() {
        Some(value) if value.abs() < 999.5 => format!("{value:>7.2}"),
        Some(value) => format!("{value:>7.0}"),
        None => format!("{:>7}", "-"),
    }
}

/// A line for each link, and one for the whole.
pub(super) fn table(document: &Value) -> String {
    let mut out = String::from("cause,runs,from,to");
    for scale in ["pixel", "block"] {
        for column in COLUMNS {
            out += &format!(",{scale}_{column}");
        }
    }
    out.push('\n');
    let quoted = |value: &Value| {
        let text = value.as_str().unwrap_or_default();
        format!("\"{}\"", text.replace('"', "\"\""))
    };
    let numbers = |value: &Value| -> String {
        let cell = |scale: &str, column: &str| {
            let value = value[scale][column].as_f64();
            value.map_or_else(|| ",".into(), |v| format!(",{v}"))
        };
        ["pixel", "block"]
            .iter()
            .flat_map(|scale| COLUMNS.iter().map(move |column| cell(scale, column)))
            .collect()
    };
    for link in document["links"].as_array().into_iter().flatten() {
        let cause = link["cause"].as_str().unwrap_or_default();
        let (from, to) = (quoted(&link["from"]), quoted(&link["to"]));
        out += &format!("{cause},{},{from},{to}{}\n", link["runs"], numbers(link));
    }
    out += &format!("whole,true,,{}\n", numbers(&document["whole"]));
    out
}
