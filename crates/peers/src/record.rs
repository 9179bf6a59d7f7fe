//! Runs the benchmarks and writes the results: CSV tables, the host as JSON, and a README.

use std::path::Path;

use serde::Serialize;

use crate::command::{cargo, run};
use crate::host::Host;
use crate::{messages, profile, rays, scenes};

/// The first part of the README: how the results are measured.
const HEAD: &str = include_str!("../README-of-results.md");

/// Runs all benchmarks, then writes the results into a folder.
pub fn record(out: &Path, rounds: u16) -> Result<(), String> {
    let (embree, simgrid) = (rays::EMBREE.build()?, messages::SIMGRID.build()?);
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let profile = profile::measure(&folder)?;
    let host = Host::here();
    let mut casts = Vec::new();
    for scene in scenes::scenes(&[], &folder)? {
        casts.push(rays::measure(&embree, &scene, rounds)?);
    }
    let messages = messages::measure(&simgrid, rounds)?;
    let benches = run(cargo().args(["bench", "--quiet"]), "cargo")?;

    let mut readme = format!("{HEAD}\n## Where\n\n{}\n", host.list());
    readme += "## Rays, beside Embree\n";
    readme.extend(casts.iter().map(|rows| rays::table(rows)));
    readme += "\n## Messages, beside SimGrid\n";
    readme += &messages::table(&messages);
    readme += "\n## Where the time goes\n";
    readme += &profile::table(&profile);
    let host = serde_json::to_string_pretty(&host).map_err(|error| error.to_string())? + "\n";
    let rays: Vec<rays::Row> = casts.into_iter().flatten().collect();
    for (name, text) in [
        ("README.md", readme),
        ("host.json", host),
        ("rays.csv", csv(&rays)?),
        ("messages.csv", csv(&messages)?),
        ("profile-table1.csv", csv(&profile.table1)?),
        ("profile-office.csv", csv(&profile.office)?),
        ("profile-kernel.csv", csv(&profile.kernel)?),
        ("cargo-bench.txt", benches),
    ] {
        write(out, name, &text)?;
    }
    Ok(())
}

pub fn csv(rows: &[impl Serialize]) -> Result<String, String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    rows.iter().try_for_each(|row| writer.serialize(row)).map_err(|error| error.to_string())?;
    let bytes = writer.into_inner().map_err(|error| error.to_string())?;
    String::from_utf8(bytes).map_err(|error| error.to_string())
}

/// Writes one file into a folder, which is created if necessary.
pub fn write(folder: &Path, name: &str, text: &str) -> Result<(), String> {
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    lab::write_file(&folder.join(name), text.as_bytes()).map_err(|error| error.to_string())
}
