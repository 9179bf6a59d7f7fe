//! In words: which node finished last, what it was doing, and what kept a run from being faster. All
//! of it is computed from the recording.

use std::fmt::Write;

use crate::film::Doing;
use crate::reel::Told;

/// Sentences on one run; `alone` is its sibling on one processor, if that was recorded.
pub(crate) fn sentences(told: &Told, alone: Option<&Told>) -> Vec<String> {
    let mut sentences = vec![finish(told), busiest(told)];
    if told.processors() > 1 {
        sentences.push(lost(told));
        sentences.push(bound(told, alone));
        sentences.push(chain(told));
    }
    sentences
}

fn finish(told: &Told) -> String {
    let account = &told.account;
    let (last, end) = account.last;
    let end = end.as_seconds_f64();
    let Some((node, at)) = account.last_shot else {
        return format!(
            "Nothing was shot; node {last} was the last to know of the end, at {}.",
            s(end)
        );
    };
    let at = at.as_seconds_f64();
    let shots = &told.reel.film.recording.nodes[node].shots;
    let what = shots.last().map_or(String::new(), |shot| {
        let (here, there) = (shot.environment, shot.source_environment);
        match here == there {
            true => format!("a patch of its own environment {here}"),
            false => format!("light from environment {there} in its environment {here}"),
        }
    });
    format!(
        "Node {node} finished work last: until {} it shot {what}. The end was then found out and announced, \
         and node {last} was the last to know of it, at {}.",
        s(at),
        s(end),
    )
}

fn busiest(told: &Told) -> String {
    let account = &told.account;
    let node = account.busiest;
    let ledger = &account.nodes[node];
    let shots = &told.reel.film.recording.nodes[node].shots;
    let local = shots.iter().filter(|shot| shot.environment == shot.source_environment).count();
    format!(
        "The busiest node is {node}: {} of {} it computed, on {} of its own patches ({}) and {} received \
         sources ({}); it waited for {}.",
        s(ledger.computing()),
        s(told.seconds()),
        local,
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
    let mut text = format!(
        "Of all nodes' time {} went into computing, {} into messages",
        share(all.computing()),
        share(all.overhead())
    );
    let paging = all.of_doing(Doing::Paging);
    if paging > 0.0 {
        // Writing to a string cannot fail.
        let _ = write!(text, ", {} into paging", share(paging));
    }
    text + &format!(
        " and {} into waiting: {} before a node had anything to shoot, {} between its shots, {} after \
         its last one, while others still worked.",
        share(all.waiting()),
        share(all.before),
        share(all.between),
        share(all.after),
    )
}

fn bound(told: &Told, alone: Option<&Told>) -> String {
    let account = &told.account;
    let nodes = told.processors();
    let work = account.all.computing();
    let busiest = account.nodes[account.busiest].computing();
    let base = alone.map_or(work, Told::seconds);
    let mut text = format!(
        "The work is uneven: the busiest node computes {:.1} times the mean, so that with this work a node \
         no order of it gives a speed-up above {:.1}",
        busiest * nodes as f64 / work,
        base / busiest
    );
    if alone.is_some() {
        let _ = write!(text, " (it is {:.1}, of {nodes} at best)", base / told.seconds());
    }
    let some = account.with_sources;
    text + &match some {
        _ if some == nodes => ". Every node has patches of its own to shoot.".to_owned(),
        _ => format!(
            ". Only {some} of {nodes} nodes have patches to shoot; the others have nothing to do until \
             light reaches them, and less where little light comes."
        ),
    }
}

fn chain(told: &Told) -> String {
    let path = &told.account.path;
    let whole = told.seconds();
    let share = |doing: &[Doing]| doing.iter().map(|&d| path[d as usize]).sum::<f64>() / whole;
    let shots = share(&[Doing::LocalShot, Doing::ReceivedShot, Doing::Selection]);
    let messages =
        share(&[Doing::Sending, Doing::Receiving, Doing::Control, Doing::Held, Doing::Travelling]);
    let mut nodes: Vec<usize> = told.path.iter().map(|link| link.node).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let rest = share(&[Doing::Paging, Doing::Waiting]);
    let verdict = if shots > 0.8 {
        "So neither the network nor the order of messages holds the run up, but who has which work: load \
         imbalance."
    } else if messages > 0.5 {
        "So the run waits for messages."
    } else {
        "So no one cause holds the run up."
    };
    format!(
        "The critical path, the chain of work and messages that decided the end, leads over {} nodes: {} of \
         it is computing, {} messages, {} paging and unexplained waiting. {verdict}",
        nodes.len(),
        percent(shots),
        percent(messages),
        percent(rest),
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
    let digits = if share >= 0.0995 || share == 0.0 { 0 } else { 1 };
    format!("{:.digits$} %", 100.0 * share)
}
