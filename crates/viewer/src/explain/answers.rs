//! Answers in words: which node finished last, what it was doing, and why a run was not faster.

use super::analysed_run::AnalysedRun;
use super::critical_path::PathSegment;
use super::format::{exact_seconds, factor, percent, seconds};
use super::loss::Loss;
use crate::record::NodeState;

/// Questions about a run with their answers; `alone` is the same run on one processor, if that was
/// recorded.
pub(crate) fn answers(
    run: &AnalysedRun,
    alone: Option<&AnalysedRun>,
) -> Vec<(&'static str, String)> {
    let mut answers = vec![("Which node finished last, and what was it doing?", finish(run))];
    if run.processors() > 1 && run.last_shot.is_some() {
        answers.push(("Why is it not faster?", why(run, alone)));
    }
    answers.push(("Which node worked most?", busiest(run)));
    if run.processors() > 1 {
        answers.push(("Where did all nodes\u{2019} time go?", lost(run)));
        answers.push(("What determined when it ended?", critical(run)));
    }
    answers
}

fn finish(run: &AnalysedRun) -> String {
    let (last, end) = run.last;
    let end = exact_seconds(end.as_seconds_f64());
    let Some((node, at)) = run.last_shot else {
        return format!(
            "Nothing was shot. Node {last} learned last that the run had ended, at {end}."
        );
    };
    let at = exact_seconds(at.as_seconds_f64());
    let shots = &run.run.recording.recording.nodes[node].shots;
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
        "Node {node} worked last: it shot {what} until {at}. Then the end was detected and announced; node \
         {last} learned of it last, at {end}."
    )
}

fn busiest(run: &AnalysedRun) -> String {
    let node = run.busiest;
    let breakdown = &run.nodes[node];
    let shots = &run.run.recording.recording.nodes[node].shots;
    let local = shots.iter().filter(|shot| shot.environment == shot.source_environment).count();
    format!(
        "Node {node}. Of {} it computed for {}: it shot {local} patches of its own ({}) and {} received sources \
         ({}). It waited for {}.",
        seconds(run.seconds()),
        seconds(breakdown.computing()),
        seconds(breakdown.in_state(NodeState::LocalShot)),
        shots.len() - local,
        seconds(breakdown.in_state(NodeState::ReceivedShot)),
        seconds(breakdown.waiting()),
    )
}

fn lost(run: &AnalysedRun) -> String {
    let all = &run.all;
    let whole = run.seconds() * run.processors() as f64;
    let share = |part: f64| percent(part / whole);
    let paging = match all.in_state(NodeState::Paging) {
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

fn critical(run: &AnalysedRun) -> String {
    let share = |states: &[NodeState]| {
        states.iter().map(|&state| run.path_seconds[state as usize]).sum::<f64>() / run.seconds()
    };
    let is_shot = |segment: &&PathSegment| {
        matches!(segment.state, NodeState::LocalShot | NodeState::ReceivedShot)
    };
    let shots = run.path.iter().filter(is_shot).count();
    let mut nodes = vec![0.0; run.processors()];
    for segment in run.path.iter().filter(is_shot) {
        nodes[segment.node] += (segment.to - segment.from).as_seconds_f64();
    }
    let mut nodes: Vec<(usize, f64)> =
        nodes.into_iter().enumerate().filter(|(_, time)| *time > 0.0).collect();
    nodes.sort_by(|a, b| b.1.total_cmp(&a.1));
    let on = |&(node, time): &(usize, f64)| format!("{} on node {node}", seconds(time));
    let mut named: Vec<String> = nodes.iter().take(3).map(on).collect();
    named.extend((nodes.len() > 3).then(|| "less on others".to_owned()));
    let rest = match share(&[NodeState::Paging, NodeState::Waiting]) {
        0.0 => String::new(),
        rest => format!(", {} paging or unexplained waiting", percent(rest)),
    };
    format!(
        "The critical path, the gapless chain of work and messages that led to the end: {shots} shots, {}. \
         {} of its length is computing, {} messages{rest}. The timeline shows it.",
        named.join(", "),
        percent(share(&NodeState::COMPUTING)),
        percent(share(&NodeState::OVERHEAD)),
    )
}

fn why(run: &AnalysedRun, alone: Option<&AnalysedRun>) -> String {
    let nodes = run.processors();
    let loss = Loss::of(run, alone);
    let busiest = run.nodes[run.busiest].computing();
    let published = run.run.published.map(|speed_up| format!(" (published: {speed_up})"));
    let more = match alone {
        Some(_) => format!("{} from more work than on one processor, ", factor(loss.more)),
        None => String::new(),
    };
    format!(
        "{} The speed-up is {:.1} of {nodes}{}. The missing factor is {}: {more}{} from uneven distribution of the \
         work, {} from what the busiest node does besides computing. Distributed evenly, the work would take {}; \
         node {} alone has {} of it, {} times the mean, so no order of work and no network could give a speed-up \
         above {:.1}. {}{}",
        loss.verdict(run),
        loss.base / run.seconds(),
        published.unwrap_or_default(),
        factor(nodes as f64 * run.seconds() / loss.base),
        factor(loss.uneven),
        factor(loss.waits),
        seconds(run.all.computing() / nodes as f64),
        run.busiest,
        seconds(busiest),
        factor(loss.uneven),
        loss.base / busiest,
        largest_environment(run, loss.base),
        sources(run),
    )
}

/// The limit that the most expensive environment sets, on any number of processors.
fn largest_environment(run: &AnalysedRun, base: f64) -> String {
    let most = run.environments.iter().copied().fold(0.0, f64::max);
    let Some(number) = run.environments.iter().position(|&time| time == most && most > 0.0) else {
        return String::new();
    };
    format!(
        "More processors would not give more than {:.1} either: an environment is never divided, and the shots in \
         environment {number} alone take {}. ",
        base / most,
        seconds(most),
    )
}

fn sources(run: &AnalysedRun) -> String {
    let nodes = run.processors();
    match run.with_sources {
        some if some == nodes => "Every node has patches of its own to shoot.".to_owned(),
        some => format!(
            "Only {some} of {nodes} nodes have patches of their own to shoot: the others have nothing to do until \
             light reaches them."
        ),
    }
}
