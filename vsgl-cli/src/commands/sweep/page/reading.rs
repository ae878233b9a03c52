//! How to read the page, in a few sentences.

use super::choice::Choice;
use super::text::{escape, number};
use super::{command, points, reference, words};
use serde_json::Value;

/// Below the chart.
pub(super) fn chart_note(document: &Value, choice: &Choice) -> String {
    let noise = choice.noise(document).map_or(String::new(), |noise| {
        format!(
            " The noise of the reference itself is {} % (grey, where the chart reaches so far).",
            number(noise)
        )
    });
    format!(
        "{}. Further down and further left is better. Full marks on the line are the front: nothing else is both faster \
         and nearer to the truth on that backend. Bars reach from the fastest to the slowest run.{noise}",
        capital(&choice.words())
    )
}

fn capital(text: &str) -> String {
    let mut chars = text.chars();
    let first = chars.next().map(|c| c.to_uppercase().to_string());
    first.unwrap_or_default() + chars.as_str()
}

/// At the end of the page.
pub(super) fn section(document: &Value, choice: &Choice) -> String {
    let made = match reference(document) {
        text if text.is_empty() => String::new(),
        text => format!(" Here: {}.", escape(&text)),
    };
    let noise = choice.noise(document).map_or(String::new(), |noise| {
        format!(
            " In this sweep it is {} % ({}).",
            number(noise),
            escape(&choice.words())
        )
    });
    let runs: Vec<_> = points(document)
        .iter()
        .filter_map(|p| p["runs"].as_u64())
        .collect();
    let runs = match (runs.iter().min(), runs.iter().max()) {
        (Some(least), Some(most)) if least == most => format!(" Here: {least}."),
        (Some(least), Some(most)) => format!(" Here: {least} to {most}."),
        _ => String::new(),
    };
    let line = words(document, "command");
    let again = match line.is_empty() {
        true => String::new(),
        false => format!(
            "<p>This sweep again, or on from where it stopped:</p>\n{}",
            command(line)
        ),
    };
    format!(
        "<section id=\"reading\">\n<h2>How to read this</h2>\n<dl>\n\
         <dt>Error</dt><dd>How far the luminance of a picture is from that of the reference, as a share of the \
         reference. <b>mape</b> is the mean of |x − r| ∕ r, <b>rmspe</b> the root of the mean square of it, which a few \
         bad pixels dominate; <b>smape</b> divides by the mean of both and cannot exceed 200 %; <b>relmse</b> is the \
         mean of (x − r)² ∕ r², without unit; <b>bias</b> is how much light there is too much or too little in all. \
         Where the reference is darker than 1 % of its mean, that 1 % takes its place below the line.</dd>\n\
         <dt>Pixels and boxes</dt><dd>Over each pixel an error counts noise like a fault. The mean over boxes of 8 × 8 \
         pixels removes noise that the eye, or a denoiser, removes as well; what remains is wrong over a whole patch. \
         Both can be chosen above.</dd>\n\
         <dt>Indirect light, whole picture</dt><dd>Virtual lights make the light of one bounce alone; the rest of the \
         picture is the same for all settings and hides their errors.</dd>\n\
         <dt>The reference and its noise</dt><dd>A picture that is right in the mean, with noise of its own.{made} Its \
         noise is estimated by comparing halves of it; an error that is not clearly above it says nothing but that it \
         is small.{noise}</dd>\n\
         <dt>Time</dt><dd>From the first phase of a frame until the picture is complete, without loading the scene; the \
         median of the runs, after one to warm up.{runs} Wall time is what passes; CPU time adds up all threads. A \
         graphics card has no CPU time of its own.</dd>\n\
         <dt>Front</dt><dd>The settings for which no others are both faster and nearer to the truth. It depends on \
         what is chosen above and is found again for each choice.</dd>\n</dl>\n{again}</section>\n"
    )
}
