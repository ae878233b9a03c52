//! What a sweep found, for people and for machines.

use super::advice::error;
use super::{Sweep, seconds};
use crate::commands::{SCHEMA_VERSION, facts};
use crate::output;
use crate::text;
use serde_json::{Value, json};

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
