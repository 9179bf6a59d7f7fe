//! In words: which node finished last, what it was doing, and what kept a run from being faster. All
//! of it is computed from the recording.

use std::fmt::Write;

use crate::critical::Link;
use crate::film::Doing;
use crate::reel::Told;

/// A question and its answer.
pub(crate) type Answer = (&'static str, String);

/// What one asks of a run; `alone` is its sibling on one processor, if that was recorded.
pub(crate) fn answers(told: &Told, alone: Option<&Told>) -> Vec<Answer> {
    let mut answers = vec![
        ("Which node finished last, and what was it doing?", finish(told)),
        ("Which node worked most?", busiest(told)),
    ];
    if told.processors() > 1 {
        answers.push(("Where did all nodes\u{2019} time go?", lost(told)));
        answers.push(("What decided when it ended?", chain(told)));
        answers.push(("Why is it not faster?", bound(told, alone)));
    }
    answers
}

fn finish(told: &Told) -> String {
    let account = &told.account;
    let (last, end) = account.last;
    let end = exact(end.as_seconds_f64());
    let Some((node, at)) = account.last_shot else {
        return format!("Nothing was shot. Node {last} was the last to know of the end, at {end}.");
    };
    let at = exact(at.as_seconds_f64());
    let shots = &told.reel.film.recording.nodes[node].shots;
    let what = shots.last().map_or(String::new(), |shot| {
        let (here, there) = (shot.environment, shot.source_environment);
        match here == there {
            true => format!("a patch of its own environment {here} (a local shot)"),
            false => format!(
                "light from environment {there} in its environment {here} (a received shot)"
            ),
        }
    });
    format!(
        "Node {node} worked last: it shot {what} until {at}. Then the end was found out and announced; node \
         {last} was the last to know of it, at {end}."
    )
}

fn busiest(told: &Told) -> String {
    let account = &told.account;
    let node = account.busiest;
    let ledger = &account.nodes[node];
    let shots = &told.reel.film.recording.nodes[node].shots;
    let local = shots.iter().filter(|shot| shot.environment == shot.source_environment).count();
    format!(
        "Node {node}: of {} it computed for {}, on {local} patches of its own ({}) and {} received sources \
         ({}), and waited for {}.",
        s(told.seconds()),
        s(ledger.computing()),
        s(ledger.of_doing(Doing::LocalShot)),
        shots.len() - local,
        s(ledger.of_doing(Doing::ReceivedShot)),
        s(ledger.waiting()),
    )
}

fn lost(told: &Told) -> String {
    let all = &told.account.all;
    let whole = told.seconds() * told.processors() as f64;
    let share = |part: f64| percent(part / whole);
    let paging = match all.of_doing(Doing::Paging) {
        0.0 => String::new(),
        paging => format!(", {} into paging", share(paging)),
    };
    format!(
        "{} of it went into computing, {} into messages{paging}, and {} was spent waiting: {} before a node \
         had anything to shoot, {} between its shots, {} after its last one, while others still worked.",
        share(all.computing()),
        share(all.overhead()),
        share(all.waiting()),
        share(all.before),
        share(all.between),
        share(all.after),
    )
}

/// Of the critical path, the shares of computing, of messages, and of the rest.
fn path_shares(told: &Told) -> [f64; 3] {
    let share = |doing: &[Doing]| {
        doing.iter().map(|&d| told.account.path[d as usize]).sum::<f64>() / told.seconds()
    };
    [
        share(&[Doing::LocalShot, Doing::ReceivedShot, Doing::Selection]),
        share(&[Doing::Sending, Doing::Receiving, Doing::Control, Doing::Held, Doing::Travelling]),
        share(&[Doing::Paging, Doing::Waiting]),
    ]
}

fn chain(told: &Told) -> String {
    let [computing, messages, rest] = path_shares(told);
    let shoots = |link: &&Link| matches!(link.doing, Doing::LocalShot | Doing::ReceivedShot);
    let mut nodes: Vec<usize> = told.path.iter().filter(shoots).map(|link| link.node).collect();
    let shots = nodes.len();
    nodes.sort_unstable();
    nodes.dedup();
    format!(
        "The critical path, the chain of work and messages that led to the end without a gap: {shots} shots on \
         {} node{}. {} of its length is computing, {} messages, {} paging or waiting for nothing recorded.",
        nodes.len(),
        if nodes.len() == 1 { "" } else { "s" },
        percent(computing),
        percent(messages),
        percent(rest),
    )
}

fn bound(told: &Told, alone: Option<&Told>) -> String {
    let account = &told.account;
    let nodes = told.processors();
    let work = account.all.computing();
    let busiest = account.nodes[account.busiest].computing();
    let base = alone.map_or(work, Told::seconds);
    let (speed_up, most) = (base / told.seconds(), base / busiest);
    let [computing, messages, _] = path_shares(told);
    let verdict = match (computing, messages) {
        _ if speed_up > 0.8 * nodes as f64 => "Hardly anything holds it up.",
        (shots, _) if shots > 0.8 && speed_up > 0.8 * most => "Load imbalance.",
        (shots, _) if shots > 0.8 => "Load imbalance, and shots that must wait for each other.",
        (_, messages) if messages > 0.5 => "It waits for messages.",
        _ => "No one cause holds it up.",
    };
    let some = account.with_sources;
    let sources = match some {
        _ if some == nodes => "Every node has patches of its own to shoot.".to_owned(),
        _ => format!(
            "Only {some} of {nodes} nodes have patches to shoot: the others have nothing to do until light \
             reaches them, and little where little comes."
        ),
    };
    format!(
        "{verdict} The speed-up is {speed_up:.1} of {nodes}. The busiest node computes {:.1} times the mean; \
         with its work as it is, no order of work and no network could give more than {most:.1}. {sources}",
        busiest * nodes as f64 / work,
    )
}

/// A table of runs that differ in the number of processors alone: what stops the speed-up.
pub(crate) fn table(runs: &[&Told]) -> String {
    let alone = runs.iter().find(|told| told.processors() == 1);
    let mut rows = String::new();
    for told in runs {
        let account = &told.account;
        let nodes = told.processors() as f64;
        let whole = told.seconds() * nodes;
        let busiest = account.nodes[account.busiest].computing();
        let base = alone.map_or(account.all.computing(), |alone| alone.seconds());
        let cells = [
            told.processors().to_string(),
            s(told.seconds()),
            format!("{:.1}", base / told.seconds()),
            percent(account.all.computing() / whole),
            format!("{} ({})", account.busiest, s(busiest)),
            format!("{:.1}", busiest * nodes / account.all.computing().max(f64::MIN_POSITIVE)),
            format!("{:.1}", base / busiest.max(f64::MIN_POSITIVE)),
            account.with_sources.to_string(),
            percent(account.all.before / whole),
            percent(account.all.between / whole),
            percent(account.all.after / whole),
            percent(account.all.overhead() / whole),
        ];
        let cells: String = cells.iter().map(|cell| format!("<td>{cell}</td>")).collect();
        let _ = writeln!(rows, "<tr>{cells}</tr>");
    }
    format!(
        "<div class=\"wide\"><table><thead><tr><th>processors</th><th>time</th><th>speed-up</th>\
         <th>computing</th><th>busiest node</th><th>its work over the mean</th>\
         <th>speed-up at most, by it</th><th>nodes that have sources</th><th>waiting before</th>\
         <th>between</th><th>after shots</th><th>messages</th></tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n"
    )
}

/// Seconds, to the microsecond.
fn exact(seconds: f64) -> String {
    format!("{seconds:.6} s")
}

/// Seconds, to four digits.
fn s(seconds: f64) -> String {
    let digits = match seconds {
        x if x >= 1000.0 => 0,
        x if x >= 100.0 => 1,
        x if x >= 10.0 => 2,
        x if x >= 1.0 => 3,
        _ => 4,
    };
    format!("{seconds:.digits$} s")
}

fn percent(share: f64) -> String {
    match share {
        0.0 => "0 %".to_owned(),
        tiny if tiny < 0.0005 => "under 0.1 %".to_owned(),
        small if small < 0.0995 => format!("{:.1} %", 100.0 * small),
        _ => format!("{:.0} %", 100.0 * share),
    }
}
