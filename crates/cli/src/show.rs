//! `virtwall show`: a scene, a machine or an experiment, whichever has the name.

use std::path::Path;

use clap::{Args, ValueEnum};
use config::unknown;
use lab::{Kind, Outline};

use crate::exit::Exit;
use crate::named::{kinds_of, names};
use crate::{machine, scene};

#[derive(Args)]
pub struct Arguments {
    /// Name of a scene, a machine or an experiment, or path to its file
    name: String,
    /// Which of them, if the name has several
    #[arg(long = "as", value_enum, value_name = "KIND")]
    kind: Option<KindArgument>,
}

#[derive(Clone, Copy, ValueEnum)]
enum KindArgument {
    Scene,
    Machine,
    Experiment,
}

/// Prints what has the name.
pub fn run(arguments: &Arguments) -> Result<String, Exit> {
    let name = &arguments.name;
    let kind = match arguments.kind {
        Some(KindArgument::Scene) => Kind::Scene,
        Some(KindArgument::Machine) => Kind::Machine,
        Some(KindArgument::Experiment) => Kind::Experiment,
        None => only_kind(name)?,
    };
    match kind {
        Kind::Scene | Kind::Obj => scene::show(name),
        Kind::Machine => machine::show(name),
        Kind::Experiment => Ok(experiment(&Outline::open(name)?)),
    }
}

/// What the name is the name of.
fn only_kind(name: &str) -> Result<Kind, Exit> {
    let kinds = kinds_of(name);
    match kinds[..] {
        [kind] => Ok(kind),
        [] if Path::new(name).is_file() => Err(Exit::bad_input(format!(
            "{name}: neither a scene, a machine nor an experiment; expected one of them"
        ))),
        [] if Path::new(name).exists() && !Path::new(name).is_dir() => {
            Err(Exit::bad_input(format!("{name}: not a regular file")))
        }
        [] => Err(Exit::bad_input(unknown("scene, machine or experiment", name, &names()))),
        _ => {
            let each: Vec<String> = kinds.iter().map(Kind::to_string).collect();
            let message = format!(
                "\"{name}\" is {}; to choose: virtwall show {name} --as scene, machine or experiment",
                each.join(" and ")
            );
            Err(Exit::bad_input(message))
        }
    }
}

fn experiment(outline: &Outline) -> String {
    let mut text = format!("{}\n", outline.title);
    text += &outline.question.iter().map(|question| format!("{question}\n")).collect::<String>();
    let mut facts = vec![("runs".to_owned(), outline.runs.to_string())];
    let swept = outline.swept.iter();
    facts.extend(swept.map(|(field, values)| (format!("{field}, swept"), values.join(", "))));
    facts.extend(outline.settings.iter().filter(|(_, value)| !value.is_empty()).cloned());
    let plots = outline.plots.iter();
    facts.extend(plots.map(|(drawn, file)| ("plot".to_owned(), format!("{drawn} ({file})"))));
    let width = facts.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0) + 2;
    let lines = facts.iter().map(|(name, value)| format!("{name:<width$}{value}\n"));
    text + "\n" + &lines.collect::<String>()
}
