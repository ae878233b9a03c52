//! The program with a file, within bounds of time and memory.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// What a run may compute \[s\].
pub(crate) const SECONDS: f64 = 5.0;
/// When a run is stopped by the clock on the wall \[s\].
const STOP: f64 = 6.0 * SECONDS;
/// What a run may take at most at one time \[KiB\].
pub(crate) const PEAK: u64 = 1_000_000_000 / 1024;

/// How a run ended.
pub(crate) struct Ran {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
    /// Time by the clock on the wall \[s\].
    pub(crate) wall: f64,
    /// Time that it computed, threads added up \[s\]: what others on the machine do is no fault of a file. Where the
    /// system does not tell, as `wall`.
    pub(crate) seconds: f64,
    /// Largest resident set \[KiB\]; none where the system does not tell.
    pub(crate) peak: Option<u64>,
}

/// Runs the program in `folder`, without graphics drivers, and stops it when it takes far too long.
pub(crate) fn run(folder: &Path, arguments: &[&str]) -> Ran {
    let usage_file = folder.join("usage");
    let (out_file, err_file) = (folder.join("out"), folder.join("err"));
    let create = |path: &Path| Stdio::from(fs::File::create(path).expect("writable"));
    // The shell takes address space away, so that a fault cannot take the machine's memory.
    let limited = cfg!(unix);
    let program = env!("CARGO_BIN_EXE_vsgl-under-test");
    let mut command = if limited {
        let mut shell = Command::new("sh");
        shell.args(["-c", "ulimit -v 8000000; exec \"$0\" \"$@\"", program]);
        shell
    } else {
        Command::new(program)
    };
    command
        .args(arguments)
        .current_dir(folder)
        .env("VSGL_USAGE_FILE", &usage_file)
        .env("VK_DRIVER_FILES", "/nonexistent")
        .env("VK_ICD_FILENAMES", "/nonexistent")
        .env_remove("VK_ADD_DRIVER_FILES")
        .env_remove("VSGL_ADAPTER")
        .env("XDG_RUNTIME_DIR", folder)
        .stdin(Stdio::null())
        .stdout(create(&out_file))
        .stderr(create(&err_file));
    let start = Instant::now();
    let mut child = command.spawn().expect("the program starts");
    let mut pause = Duration::from_millis(1);
    let code = loop {
        if let Some(status) = child.try_wait().expect("a child") {
            break status.code();
        }
        if start.elapsed().as_secs_f64() > STOP {
            child.kill().expect("a child");
            child.wait().expect("a child");
            break None;
        }
        std::thread::sleep(pause);
        pause = (pause * 2).min(Duration::from_millis(20));
    };
    let wall = start.elapsed().as_secs_f64();
    let text =
        |path: &Path| String::from_utf8_lossy(&fs::read(path).unwrap_or_default()).into_owned();
    let usage = text(&usage_file);
    let usage = usage.split_once(' ');
    let peak = usage.and_then(|(kib, _)| kib.parse().ok());
    let computed = usage.and_then(|(_, seconds)| seconds.parse().ok());
    let (out, err) = (text(&out_file), text(&err_file));
    for path in [&usage_file, &out_file, &err_file] {
        let _ = fs::remove_file(path);
    }
    Ran {
        code,
        out,
        err,
        wall,
        seconds: computed.unwrap_or(wall),
        peak,
    }
}

impl Ran {
    /// What is wrong with a run that may end well or with a refusal.
    pub(crate) fn fault(&self) -> Option<String> {
        let shown = |text: &str| text.chars().take(600).collect::<String>();
        match self.code {
            Some(0 | 3) => {}
            _ if self.wall > STOP => return Some(format!("stopped after {:.1} s", self.wall)),
            code => return Some(format!("exit code {code:?}: {}", shown(&self.err))),
        }
        if self.err.contains("panicked") {
            return Some(format!("panicked: {}", shown(&self.err)));
        }
        if self.seconds > SECONDS {
            return Some(format!("took {:.1} s", self.seconds));
        }
        if self.peak.is_some_and(|peak| peak > PEAK) {
            return Some(format!("took {} MB", self.peak.unwrap_or(0) / 1000));
        }
        let unfit = |c: char| {
            (c.is_control() && !matches!(c, '\n' | '\t'))
                || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
        };
        for text in [&self.out, &self.err] {
            if let Some(c) = text.chars().find(|&c| unfit(c)) {
                return Some(format!("{c:?} reaches the terminal: {:?}", shown(text)));
            }
            if text.len() > 100_000 && !text.starts_with('{') {
                return Some(format!("{} bytes of text", text.len()));
            }
        }
        if self.code == Some(3) && self.refusal().is_none() {
            return Some(format!(
                "no `error: file: place: problem; remedy` in {:?}",
                shown(&self.err)
            ));
        }
        None
    }

    /// The message of a refusal: file, place, what is wrong, and after a semicolon what to do.
    pub(crate) fn refusal(&self) -> Option<&str> {
        let line = self
            .err
            .lines()
            .find_map(|line| line.strip_prefix("error: "))?;
        let (told, remedy) = line.rsplit_once("; ")?;
        (told.contains(": ") && !remedy.is_empty()).then_some(line)
    }
}
