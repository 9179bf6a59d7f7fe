//! The host of a measurement, versions of the tools, and the date.

use std::process::{Command, Stdio};

use serde::Serialize;

/// The properties that affect speed. The host's name is not recorded.
#[derive(Serialize)]
pub struct Host {
    processor: String,
    cores: usize,
    /// The vector instructions that the kernel has versions for.
    vectors: Vec<String>,
    memory: String,
    system: String,
    rustc: String,
    compiler: String,
    commit: String,
    date: String,
}

impl Host {
    pub fn list(&self) -> String {
        let Host { processor, cores, memory, system, rustc, compiler, commit, date, .. } = self;
        let vectors = self.vectors.join(", ");
        format!(
            "- {processor}, {cores} cores ({vectors}), {memory}, {system}\n\
             - {rustc}; {compiler}\n- commit {commit}, {date}\n"
        )
    }

    /// This host, today. Unknown properties are empty.
    pub fn here() -> Host {
        let read = |path| std::fs::read_to_string(path).unwrap_or_default();
        let (cpu, memory) = (read("/proc/cpuinfo"), read("/proc/meminfo"));
        let release = read("/proc/sys/kernel/osrelease");
        let flags = field(&cpu, "flags").unwrap_or_else(|| field(&cpu, "Features").unwrap_or(""));
        let known = ["sse4_2", "avx2", "avx512f", "avx512vl", "asimd"];
        let changed =
            !output_of("git", &["status", "--porcelain", "--untracked-files=no"]).is_empty();
        Host {
            processor: field(&cpu, "model name").unwrap_or("").to_owned(),
            cores: parallel::host_threads(),
            vectors: known
                .into_iter()
                .filter(|name| flags.split(' ').any(|flag| flag == *name))
                .map(str::to_owned)
                .collect(),
            memory: field(&memory, "MemTotal").unwrap_or("").to_owned(),
            // The release without the suffix of the distribution.
            system: format!("Linux {}", release.split('-').next().unwrap_or("").trim()),
            rustc: output_of("rustc", &["--version"]),
            compiler: output_of("c++", &["--version"]).lines().next().unwrap_or("").to_owned(),
            commit: output_of("git", &["rev-parse", "HEAD"])
                + if changed { ", changed" } else { "" },
            date: output_of("date", &["-u", "+%F"]),
        }
    }
}

fn field<'a>(text: &'a str, name: &str) -> Option<&'a str> {
    let fields = text.lines().filter_map(|line| line.split_once(':'));
    fields.map(|(key, value)| (key.trim(), value.trim())).find(|(key, _)| *key == name).map(|f| f.1)
}

/// The output of a program; empty if it fails.
fn output_of(program: &str, arguments: &[&str]) -> String {
    let output = Command::new(program).args(arguments).stderr(Stdio::null()).output();
    output.map_or(String::new(), |o| String::from_utf8_lossy(&o.stdout).trim().to_owned())
}
