//! What a sweep found, for people and for machines.

use super::advice::error;
use super::{Sweep, page, seconds};
use crate::commands::{SCHEMA_VERSION, facts};
use crate::exit::Result;
use crate::measure::front;
use crate::output::{self, Pending};
use crate::text;
use serde_json::{Value, json};
use std::io::Write as _;
use vsgl_core::settings::Settings;

/// Name of the page in the folder of the sweep.
const PAGE: &str = "report.html";

/// Time and error of a point in a few words.
pub(super) fn brief(point: &Value) -> String {
    format!("{:.3} s, error {:.2} %", seconds(point), error(point))
}

impl Sweep<'_> {
    /// All that was found.
    pub(super) fn document(&self, advice: &Value) -> Value {
        let job = &self.job;
        let (width, height) = job.view.pixels();
        let start = ["vsgl", "sweep"].map(String::from);
        let left_out = |(name, why): &(String, String)| json!({"name": name, "why": why});
        let mut document = facts::json(job);
        document["schema_version"] = SCHEMA_VERSION.into();
        document["software"] = output::software().into();
        document["command"] =
            text::shell(&[&start[..], &job.words(), &self.words()].concat()).into();
        document["width"] = width.into();
        document["height"] = height.into();
        document["machine"] = json!({
            "processor": processor(),
            "cores": std::thread::available_parallelism().map_or(0, usize::from),
            "devices": self.devices,
        });
        document["reference"] = json!({
            "source": "path",
            "spp": self.depth.spp,
            "picture": "reference.png",
            "noise": self.reference.as_ref().map(|r| &r.noise),
        });
        document["points"] = self.records.points.clone().into();
        document["left_out"] = self.left_out.iter().map(left_out).collect();
        document["advice"] = advice.clone();
        document
    }

    /// Writes what people look at.
    ///
    /// # Errors
    /// [`crate::exit::Failure::Output`] if that fails.
    pub(super) fn write_page(&self, document: &Value) -> Result<()> {
        let folder = &self.args.sweep.output;
        let picture = |name: &str| std::fs::read(folder.join(name)).ok();
        let html = page::page(&for_page(document.clone()), &picture);
        let file = Pending::create(&folder.join(PAGE))?;
        file.write(|file| file.write_all(html.as_bytes()))
    }

    /// The words that chose what was swept.
    fn words(&self) -> Vec<String> {
        let args = &self.args.sweep;
        let mut words = vec!["-o".into(), args.output.to_string_lossy().into_owned()];
        if args.quick {
            words.push("--quick".into());
        }
        for (key, values) in &args.grid {
            words.extend(["--grid".into(), format!("{key}={values}")]);
        }
        let names = args.backend.iter();
        let names: Vec<_> = names.map(|b| b.chosen().unwrap_or("auto")).collect();
        if !names.is_empty() {
            words.extend(["--backend".into(), names.join(",")]);
        }
        if let Some(runs) = args.runs {
            words.extend(["--runs".into(), runs.to_string()]);
        }
        if let Some(longest) = args.longest {
            words.extend(["--longest".into(), longest.to_string()]);
        }
        if args.threads > 0 {
            words.extend(["--threads".into(), args.threads.to_string()]);
        }
        words
    }
}

/// The document with what a page shows beside it: the usual value of a setting that only other points state, and a front
/// for each backend, since nobody has all of them.
fn for_page(mut document: Value) -> Value {
    let Some(points) = document["points"].as_array_mut() else {
        return document;
    };
    let stated = |key: &str, points: &[Value]| points.iter().any(|p| !p["settings"][key].is_null());
    for (key, usual) in Settings::default().entries() {
        if !stated(key, points) {
            continue;
        }
        for point in points.iter_mut().filter(|p| p["settings"].is_object()) {
            if point["settings"][key].is_null() {
                point["settings"][key] = usual.as_str().into();
            }
        }
    }
    let backends: Vec<Value> = points.iter().map(|p| p["backend"].clone()).collect();
    for backend in &backends {
        let of: Vec<usize> = (0..points.len())
            .filter(|i| backends[*i] == *backend)
            .collect();
        let pairs: Vec<_> = of
            .iter()
            .map(|&i| (seconds(&points[i]), error(&points[i])))
            .collect();
        for index in front(&pairs) {
            points[of[index]]["front"] = true.into();
        }
    }
    document
}

/// The processor in words, where the system tells.
fn processor() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info
        .lines()
        .find_map(|line| line.strip_prefix("model name"));
    let model = model.map(|m| m.trim_start_matches([' ', '\t', ':']).to_owned());
    model.unwrap_or_else(|| std::env::consts::ARCH.into())
}

/// The front and the advice, for people.
pub(super) fn text(document: &Value) -> String {
    let word = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let mut out = format!("{}\n\n", word(&document["command"]));
    let noise = &document["reference"]["noise"]["indirect"]["8"]["mape"];
    out += &format!(
        "reference {} paths a pixel; its own noise {} % (mape of indirect light, 8x8 box)\n",
        document["reference"]["spp"],
        noise.as_f64().map_or("?".into(), text::number)
    );
    let points = document["points"].as_array().map_or(&[][..], Vec::as_slice);
    let mut front: Vec<&Value> = points.iter().filter(|p| p["front"] == true).collect();
    front.sort_by(|a, b| seconds(a).total_cmp(&seconds(b)));
    out += &format!(
        "front     {} of {} combinations are worth their time\n",
        front.len(),
        points.len()
    );
    out += "   wall s    cpu s  error %  on    settings\n";
    for point in &front {
        let cpu = point["cpu"]["median"].as_f64();
        out += &format!(
            "{:>9.3} {:>8} {:>8.2}  {:<5} {}\n",
            seconds(point),
            cpu.map_or("-".into(), |s| format!("{s:.3}")),
            error(point),
            word(&point["backend"]),
            word(&point["name"]),
        );
    }
    let advice = document["advice"].as_array();
    for advice in advice.into_iter().flatten() {
        let Some(point) = points.iter().find(|p| p["id"] == advice["id"]) else {
            continue;
        };
        out += &format!(
            "for {:<18} {} ({})\n",
            word(&advice["for"]),
            word(&point["name"]),
            brief(point)
        );
    }
    let left_out = document["left_out"].as_array().map_or(0, Vec::len);
    if left_out > 0 {
        out += &format!("left out  {left_out} combinations; --json says why\n");
    }
    out
}
