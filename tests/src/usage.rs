//! What this process takes of memory and time.

use std::fs;

/// The largest resident set since the start or the last [`forget_peak`] \[KiB\]; none where the system does not tell
/// (it is Linux that does).
pub fn peak() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix(" kB")?.parse().ok()
}

/// Lets [`peak`] begin anew from what is resident now.
pub fn forget_peak() {
    // Refused where the system does not know of it; the peak is that of the whole process then.
    let _ = fs::write("/proc/self/clear_refs", "5");
}

/// Time that all threads of this process have computed \[s\]: what others on the machine do does not count. None where
/// the system does not tell.
pub fn computed() -> Option<f64> {
    /// Of `/proc`, wherever Linux runs.
    const TICKS_A_SECOND: f64 = 100.0;
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    // After the name, which may hold anything: state is field 3, user and system time are 14 and 15.
    let fields: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks = fields.get(11)?.parse::<f64>().ok()? + fields.get(12)?.parse::<f64>().ok()?;
    Some(ticks / TICKS_A_SECOND)
}
