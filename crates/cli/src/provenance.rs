//! What made results, and where: no result depends on it.

use std::env;
use std::time::{SystemTime, UNIX_EPOCH};

use serde_json::{Value, json};

/// Commit and compiler of this program, its command line, the time now, and the system.
#[expect(clippy::disallowed_methods, reason = "goes to host-times.json alone")]
pub fn provenance() -> Value {
    let start = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    let command = env::args_os().map(|word| word.to_string_lossy().into_owned());
    json!({
        "commit": env!("VIRTWALL_COMMIT"),
        "compiler": env!("VIRTWALL_COMPILER"),
        "command": command.collect::<Vec<String>>(),
        "start_unix_s": start,
        "operating_system": env::consts::OS,
        "architecture": env::consts::ARCH,
    })
}
