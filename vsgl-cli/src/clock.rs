//! Processor time of this process.

use std::time::Duration;

/// Time that all threads of this process have computed so far. None where the system does not tell.
#[cfg(unix)]
pub(crate) fn processor() -> Option<Duration> {
    use rustix::time::{ClockId, clock_gettime};
    let time = clock_gettime(ClockId::ProcessCPUTime);
    let (seconds, nanoseconds) = (u64::try_from(time.tv_sec), u32::try_from(time.tv_nsec));
    Some(Duration::new(seconds.ok()?, nanoseconds.ok()?))
}

/// Time that all threads of this process have computed so far. None where the system does not tell.
#[cfg(not(unix))]
pub(crate) fn processor() -> Option<Duration> {
    None
}
