//! GOAL schedules and CSV traffic: what is read, and what is refused.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::fs;

use desim::{Duration, Time};
use multicomputer::{Machine, NetworkModel, Schedule, StalledSchedule, Trace, perform};

fn row_of_4() -> Machine {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../machines/fixtures/row-of-4.json");
    Machine::from_json(&fs::read_to_string(path).unwrap(), "m.json").unwrap()
}

/// The name, start and end of each message, and the end of all, on a machine that sends 1 MB/s.
fn performed(goal: &str) -> (Vec<(String, Time, Time)>, Time) {
    let machine = row_of_4();
    let schedule = Schedule::from_goal(goal, "t.goal", machine.nodes()).unwrap();
    let mut network = machine.network_on(NetworkModel::LogGp).unwrap();
    let (messages, end) = perform(&schedule, network.as_mut()).unwrap();
    let times = messages.into_iter().map(|(message, t)| (message.name, t.sent, t.arrived));
    (times.collect(), end)
}

#[test]
fn a_schedule_computes_sends_and_receives_in_its_order() {
    let (messages, end) = performed(
        "num_ranks 3 // of four nodes
         /* a ping after
            some work */
         rank 0 { l1: calc 5000; l2: send 10b to 1 tag 3 cpu 0 nic 0
           l2 requires l1
           l3: recv 10 b from 1
           l4: calc 7000 cpu 0
           l4 requires l3
           recv 20b from 1 tag 9
         }
         rank 1 {
           a: recv 10b from 0 tag 3
           send 20b to 0 tag 9
           b: send 10b to 0
           b requires a
         }
         rank 2 { }
        ",
    );
    let [ping, early, pong] = &messages[..] else { panic!("{messages:?}") };
    assert_eq!((ping.0.as_str(), ping.1), ("0.l2", Time(5_000_000)));
    assert_eq!((early.0.as_str(), early.1), ("1.6", Time::ZERO));
    assert!(early.2 > Time::ZERO);
    assert_eq!((pong.0.as_str(), pong.1), ("1.b", ping.2));
    assert_eq!(end, pong.2 + Duration(7_000_000));
}

#[test]
fn messages_with_other_tags_wait_for_their_receive() {
    let (messages, _) = performed(
        "num_ranks 2
         rank 0 { send 1000b to 1 tag 1
                  send 1000b to 1 tag 2 }
         rank 1 { second: recv 1000b from 0 tag 2
                  first: recv 1000b from 0 tag 1
                  first requires second }",
    );
    assert!(messages[0].2 >= messages[1].2, "{messages:?}");
}

#[test]
fn faults_of_schedules_name_file_line_and_what_was_expected() {
    for (text, expected) in [
        ("", "t.goal:1: found the end; expected \"num_ranks\""),
        (
            "num_ranks 5",
            "t.goal:1: found \"5\"; expected the number of ranks; the machine has that many nodes, a whole number, at most 4",
        ),
        ("num_ranks 0", "t.goal:1: found \"0\"; expected 1 or more"),
        (
            "num_ranks 2\nrank 2 {\n}",
            "t.goal:2: found \"2\"; expected a rank, a whole number, at most 1",
        ),
        ("num_ranks 2\nrank 0 {\n", "t.goal:2: found the end; expected \"}\""),
        (
            "num_ranks 2\nrank 0 {}\nrank 0 {}",
            "t.goal:3: found rank 0 again, which begins in line 2",
        ),
        (
            "num_ranks 2\nrank 0 {\na: calc 1\nb: calc 1\nb irequires a\n}",
            "t.goal:5: found \"irequires\"; expected \"requires\": an operation begins only when others have ended",
        ),
        (
            "num_ranks 2\nrank 0 {\na: calc 1 cpu 1\n}",
            "t.goal:3: found \"1\"; expected 0, the only cpu of a node, a whole number, at most 0",
        ),
        (
            "num_ranks 2\nrank 0 {\nrecv 8b from -1\n}",
            "t.goal:3: found \"-1\"; expected a rank, a whole number, at most 1",
        ),
        (
            "num_ranks 2\nrank 0 {\nrecv 8b from 1 tag -1\n}",
            "t.goal:3: found \"-1\"; expected a tag, a whole number, at most 4294967294",
        ),
        (
            "num_ranks 2\nrank 0 {\nsend 8kb to 1\n}",
            "t.goal:3: found \"8kb\"; expected bytes such as \"8b\", at most 1000000000",
        ),
        (
            "num_ranks 2\nrank 0 {\na: calc 1\na: calc 1\n}",
            "t.goal:4: found the label \"a\" twice; expected it once",
        ),
        (
            "num_ranks 2\nrank 0 {\na: calc 1\na requires z\n}",
            "t.goal:4: found \"z\"; expected a label that stands above in this rank",
        ),
        (
            "num_ranks 2\nrank 0 {\nsend 8b to 1\n}",
            "t.goal:3: found 1 sends and 0 receives from 0 to 1 with tag 0; expected equally many",
        ),
        ("num_ranks 2\n/* rank", "t.goal:2: found a comment without end; expected \"*/\""),
        (
            "num_ranks 2\nrank 0 { \u{e9}\u{1f600} }",
            "t.goal:2: found \"\u{e9}\"; expected calc, send, recv, a label or \"}\"",
        ),
        (
            "num_ranks 2\nrank 0 { a: jump }",
            "t.goal:2: found \"jump\"; expected calc, send or recv",
        ),
    ] {
        assert_eq!(
            Schedule::from_goal(text, "t.goal", 4).unwrap_err().to_string(),
            expected,
            "{text}"
        );
    }
}

#[test]
fn operations_that_wait_for_each_other_are_reported() {
    for text in [
        "num_ranks 1\nrank 0 {\na: calc 1\nb: calc 1\na requires b\nb requires a\n}",
        "num_ranks 2\nrank 0 {\nr: recv 1b from 1\ns: send 1b to 1\ns requires r\n}
         rank 1 {\nr: recv 1b from 0\ns: send 1b to 0\ns requires r\n}",
    ] {
        let schedule = Schedule::from_goal(text, "t.goal", 4).unwrap();
        let mut network = row_of_4().network_on(NetworkModel::LogGp).unwrap();
        let stalled = perform(&schedule, network.as_mut()).unwrap_err();
        assert!(matches!(stalled, StalledSchedule::Operations { .. }), "{stalled}");
    }
}

#[test]
fn traffic_as_csv_is_in_cycles_and_flits_or_in_units() {
    let machine = row_of_4();
    let links = machine.parameters.links.as_ref();
    let read = |text: &str| Trace::from_csv(text, "t.csv", 4, links).map_err(|f| f.to_string());
    let cycle =
        Duration::from_seconds_f64(links.unwrap().flit_bytes as f64 / links.unwrap().bandwidth);
    let trace =
        read("# a comment\ncycle, source, destination, flits\n0,0,1,1\n7,3,2,20\n").unwrap();
    let [first, second] = &trace.messages[..] else { panic!("{trace:?}") };
    assert_eq!((first.at, first.from, first.to, first.name.as_str()), (Time::ZERO, 0, 1, "0"));
    assert_eq!((second.at, second.from, second.to), (Time::ZERO + cycle * 7, 3, 2));
    assert_eq!(second.bytes, 20 * links.unwrap().flit_bytes);
    let trace = read("id,time,source,destination,bytes\r\na,5 us,0,1,64\r\n").unwrap();
    assert_eq!((trace.messages[0].at, trace.messages[0].bytes), (Time(5_000_000), 64));
    for (text, expected) in [
        ("", "t.csv:1: expected a column \"cycle\" or \"time\", one of them"),
        (
            "cycle,time,source,destination,bytes\n",
            "t.csv:1: expected a column \"cycle\" or \"time\", one of them",
        ),
        (
            "cycle,source,destination\n",
            "t.csv:1: expected a column \"flits\" or \"bytes\", one of them",
        ),
        ("cycle,destination,bytes\n", "t.csv:1: no column \"source\""),
        (
            "cycle,source,destination,byte\n",
            "t.csv:1: unknown column \"byte\", did you mean \"bytes\"? (there are: id, cycle, time, source, \
             destination, bytes, flits)",
        ),
        (
            "cycle,source,destination,bytes\n0,0,1,1\n0,0,4,1\n",
            "t.csv:3: destination: found \"4\"; expected a whole number, 0 to 3",
        ),
        (
            "cycle,source,destination,bytes\n-1,0,1,1\n",
            "t.csv:2: cycle: found \"-1\"; expected a whole number, 0 to 864000000",
        ),
        (
            "cycle,source,destination,bytes\n0,0,1,1000000001\n",
            "t.csv:2: bytes: found \"1000000001\"; expected a whole number, 0 to 1000000000",
        ),
        (
            "time,source,destination,bytes\n5,0,1,1\n",
            "t.csv:2: time: found \"5\" without a unit; expected a time such as \"40 ns\"",
        ),
        (
            "time,source,destination,bytes\n100000 s,0,1,1\n",
            "t.csv:2: time: found 100000 s; expected at most 86400 s",
        ),
        (
            "id,cycle,source,destination,bytes\na,0,0,1,1\na,0,0,1,1\n",
            "t.csv:3: id: found \"a\" again; expected one of its own",
        ),
        (
            "id,cycle,source,destination,bytes\na b,0,0,1,1\n",
            "t.csv:2: id: found \"a b\"; expected a name without spaces, commas, quotes",
        ),
    ] {
        assert_eq!(read(text).unwrap_err(), expected, "{text}");
    }
    let short = read("cycle,source,destination,bytes\n0,0,1\n").unwrap_err();
    assert!(short.starts_with("t.csv:2: "), "{short}");
    let none = Trace::from_csv("cycle,source,destination,bytes\n", "t.csv", 4, None).unwrap_err();
    assert_eq!(
        none.to_string(),
        "t.csv:1: found \"cycle\"; expected a machine whose file has \"network.links\""
    );
}
