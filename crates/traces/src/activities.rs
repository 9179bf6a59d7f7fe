//! Numbers and names of activities.

use virtwall::{Activity, MessageKind};

/// Every activity, ordered by number.
pub(crate) fn activities() -> impl Iterator<Item = Activity> {
    let sends = MessageKind::all().map(Activity::Send);
    OTHERS.into_iter().chain(sends)
}

const OTHERS: [Activity; 11] = [
    Activity::Selection,
    Activity::LocalShot,
    Activity::ReceivedShot,
    Activity::Receive,
    Activity::Pack,
    Activity::Copy,
    Activity::WaitForRoom,
    Activity::Paging,
    Activity::Forward,
    Activity::WaitForDisplay,
    Activity::Wait,
];

pub(crate) fn number(activity: Activity) -> usize {
    match activity {
        Activity::Send(kind) => OTHERS.len() + kind as usize,
        other => OTHERS.iter().position(|&one| one == other).expect("it has all but sends"),
    }
}

pub(crate) fn name(activity: Activity) -> String {
    match activity {
        Activity::Send(kind) => format!("send {}", kind.name()),
        other => other.name().to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_indices() {
        assert!(activities().map(number).eq(0..19));
    }
}
