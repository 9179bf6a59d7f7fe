//! In words: which node finished last, what it was doing, and what kept a run from being faster. All
//! of it is computed from the recording.

use std::fmt::Write;

use crate::critical::Link;
use crate::film::Doing;
use crate::ledger::Ledger;
use crate::reel::Told;

/// A question and its answer.
pub(crate) type Answer = (&'static str, String);

/// What one asks of a run; `alone` is its sibling on one processor, if that was recorded.
pub(crate) fn answers(told: &Told, alone: Option<&Told>) -> Vec<Answer> {
    let mut answers = vec![("Which node finished last, and what was it doing?", finish(told))];
    if told.processors() > 1 && told.account.last_shot.is_some() {
        answers.push(("Why is it not faster?", why(told, alone)));
    }
    answers.push(("Which node worked most?", busiest(told)));
    if told.processors() > 1 {
        answers.push(("Where did all nodes\u{2019} time go?", lost(told)));
        answers.push(("What decided when it ended?", chain(told)));
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
    let shots = told.path.iter().filter(shoots).count();
    let mut nodes = vec![0.0; told.processors()];
    for link in told.path.iter().filter(shoots) {
        nodes[link.node] += (link.to - link.from).as_seconds_f64();
    }
    let mut nodes: Vec<(usize, f64)> =
        nodes.into_iter().enumerate().filter(|(_, seconds)| *seconds > 0.0).collect();
    nodes.sort_by(|a, b| b.1.total_cmp(&a.1));
    let on = |&(node, seconds): &(usize, f64)| format!("{} on node {node}", s(seconds));
    let mut named: Vec<String> = nodes.iter().take(3).map(on).collect();
    named.extend((nodes.len() > 3).then(|| "less on others".to_owned()));
    let rest = match rest {
        0.0 => String::new(),
        rest => format!(", {} paging or waiting for nothing recorded", percent(rest)),
    };
    format!(
        "The critical path, the chain of work and messages that led to the end without a gap: {shots} shots, {}. \
         {} of its length is computing, {} messages{rest}. The timeline shows it.",
        named.join(", "),
        percent(computing),
        percent(messages),
    )
}

/// What of a speed-up is missing: factors whose product is the number of processors over the speed-up.
struct Loss {
    /// Time on one processor, or, where that is not known, of all nodes' computing.
    base: f64,
    /// Work over that on one processor.
    more: f64,
    /// The busiest node's work over the mean.
    uneven: f64,
    /// The run's time over what its busiest node computed.
    waits: f64,
}

impl Loss {
    fn of(told: &Told, alone: Option<&Told>) -> Loss {
        let account = &told.account;
        let work = account.all.computing();
        let busiest = account.nodes[account.busiest].computing();
        if busiest == 0.0 {
            return Loss { base: told.seconds(), more: 1.0, uneven: 1.0, waits: 1.0 };
        }
        let base = alone.map_or(work, Told::seconds);
        let uneven = busiest * told.processors() as f64 / work;
        Loss { base, more: work / base, uneven, waits: told.seconds() / busiest }
    }

    /// In words, if one of the factors makes up more than half of it.
    fn verdict(&self, busiest: &Ledger) -> &'static str {
        let whole = self.more * self.uneven * self.waits;
        let rest = [busiest.waiting(), busiest.overhead(), busiest.of_doing(Doing::Paging)];
        let most = rest.iter().copied().fold(0.0, f64::max);
        let waits = match rest.iter().position(|&part| part == most) {
            Some(1) => "Its busiest node gives its time to messages.",
            Some(2) => "Its busiest node pages.",
            _ => "Its busiest node waits for light to come.",
        };
        let causes = [
            (self.more, "It does more work than one processor does."),
            (self.uneven, "The work lies unevenly on its nodes."),
            (self.waits, waits),
        ];
        let main = causes.iter().find(|(factor, _)| factor.ln() > 0.5 * whole.ln());
        match main {
            _ if whole < 1.25 => "Hardly anything holds it up.",
            Some((_, cause)) => cause,
            None => "No one cause holds it up.",
        }
    }
}

fn why(told: &Told, alone: Option<&Told>) -> String {
    let account = &told.account;
    let nodes = told.processors();
    let loss = Loss::of(told, alone);
    let busiest = &account.nodes[account.busiest];
    let published = told.reel.published.map(|speed_up| format!(" (published: {speed_up})"));
    let more = match alone {
        Some(_) => format!("{} by more work than on one processor, ", factor(loss.more)),
        None => String::new(),
    };
    format!(
        "{} The speed-up is {:.1} of {nodes}{}. What is missing is a factor of {}: {more}{} by work that lies \
         unevenly, {} by what the busiest node does beside its work. Shared out evenly, the work would take {}; \
         node {} alone has {} of it, {} times the mean, so that no order of work and no network could give more than \
         {:.1}. {}{}",
        loss.verdict(busiest),
        loss.base / told.seconds(),
        published.unwrap_or_default(),
        factor(nodes as f64 * told.seconds() / loss.base),
        factor(loss.uneven),
        factor(loss.waits),
        s(account.all.computing() / nodes as f64),
        account.busiest,
        s(busiest.computing()),
        factor(loss.uneven),
        loss.base / busiest.computing(),
        indivisible(told, loss.base),
        sources(told),
    )
}

/// Where more processors end to be of use.
fn indivisible(told: &Told, base: f64) -> String {
    let environments = &told.account.environments;
    let most = environments.iter().copied().fold(0.0, f64::max);
    let Some(number) = environments.iter().position(|&seconds| seconds == most && most > 0.0)
    else {
        return String::new();
    };
    format!(
        "Nor could more processors: an environment is never divided, and shots in environment {number} alone take \
         {}, which bounds the speed-up by {:.1} however many there are. ",
        s(most),
        base / most,
    )
}

fn sources(told: &Told) -> String {
    match told.account.with_sources {
        some if some == told.processors() => {
            "Every node has patches of its own to shoot.".to_owned()
        }
        some => format!(
            "Only {some} of {} nodes have patches to shoot: the others have nothing to do until light reaches \
             them, and little where little comes.",
            told.processors()
        ),
    }
}

/// A table of runs that differ in the number of processors alone: what stops the speed-up.
pub(crate) fn table(runs: &[&Told]) -> String {
    let alone = runs.iter().find(|told| told.processors() == 1).copied();
    let mut rows = String::new();
    for told in runs {
        let account = &told.account;
        let whole = told.seconds() * told.processors() as f64;
        let loss = Loss::of(told, alone);
        let share = |part: f64| percent(part / whole).replace("under", "&lt;");
        let cells = [
            s(told.seconds()),
            format!("{:.1}", loss.base / told.seconds()),
            factor(loss.more),
            factor(loss.uneven),
            factor(loss.waits),
            format!("{} ({})", account.busiest, s(account.nodes[account.busiest].computing())),
            account.with_sources.to_string(),
            share(account.all.computing()),
            share(account.all.overhead()),
            share(account.all.before),
            share(account.all.between),
            share(account.all.after),
        ];
        let cells: String = cells.iter().map(|cell| format!("<td>{cell}</td>")).collect();
        let _ = writeln!(rows, "<tr><th scope=\"row\">{}</th>{cells}</tr>", told.processors());
    }
    format!(
        "<div class=\"wide\"><table class=\"losses\">{HEAD}<tbody>\n{rows}</tbody></table></div>\n"
    )
}

/// What the columns of the table are.
const HEAD: &str = "<caption>Speed-up, times what is missing, is the number of processors: more work than on one, \
    the busiest node\u{2019}s work over the mean, and the whole time over what that node \
    computes.</caption>\n<thead><tr><td colspan=\"3\"></td><th colspan=\"3\" scope=\"colgroup\">missing, by \
    factors</th><td colspan=\"2\"></td><th colspan=\"2\" scope=\"colgroup\">of all time</th>\
    <th colspan=\"3\" scope=\"colgroup\">waiting, and when</th></tr>\n<tr><th scope=\"col\">processors</th>\
    <th scope=\"col\">time</th><th scope=\"col\">speed-up</th><th scope=\"col\">more work</th>\
    <th scope=\"col\">uneven</th><th scope=\"col\">waits</th><th scope=\"col\">busiest node</th>\
    <th scope=\"col\">nodes with sources</th><th scope=\"col\">computing</th><th scope=\"col\">messages</th>\
    <th scope=\"col\">before</th><th scope=\"col\">between</th><th scope=\"col\">after shots</th></tr></thead>";

/// A factor, to three digits.
fn factor(factor: f64) -> String {
    if factor < 9.995 { format!("{factor:.2}") } else { format!("{factor:.1}") }
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
        // A little less than all is not all.
        most if (0.995..1.0).contains(&most) => format!("{:.1} %", (100.0 * most).min(99.9)),
        _ => format!("{:.0} %", 100.0 * share),
    }
}
