//! The states of a node that the page distinguishes; between them a node waits.

use virtwall::{Activity, MessageKind};

/// What a node does. `assets/data/run.js` has the same list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NodeState {
    LocalShot,
    ReceivedShot,
    Selection,
    Sending,
    Receiving,
    Control,
    Paging,
    Held,
    /// Only on a critical path: a message is under way.
    Travelling,
    /// Only on a critical path: a wait that nothing recorded explains.
    Waiting,
}

impl NodeState {
    pub const COUNT: usize = NodeState::Waiting as usize + 1;
    /// In kernels.
    pub const COMPUTING: [NodeState; 3] =
        [NodeState::LocalShot, NodeState::ReceivedShot, NodeState::Selection];
    /// Busy with messages.
    pub const OVERHEAD: [NodeState; 5] = [
        NodeState::Sending,
        NodeState::Receiving,
        NodeState::Control,
        NodeState::Held,
        NodeState::Travelling,
    ];

    pub fn of(activity: Activity) -> NodeState {
        match activity {
            Activity::Selection => NodeState::Selection,
            Activity::LocalShot => NodeState::LocalShot,
            Activity::ReceivedShot => NodeState::ReceivedShot,
            Activity::Send(MessageKind::Token | MessageKind::Done) => NodeState::Control,
            Activity::Send(MessageKind::Collect | MessageKind::Sums) => NodeState::Control,
            Activity::Send(MessageKind::StopSelecting) => NodeState::Control,
            Activity::Send(_) | Activity::Pack | Activity::Forward => NodeState::Sending,
            Activity::Receive | Activity::Copy => NodeState::Receiving,
            Activity::WaitForRoom | Activity::WaitForDisplay => NodeState::Held,
            Activity::Paging => NodeState::Paging,
            Activity::Wait => NodeState::Waiting,
        }
    }
}

pub(crate) fn is_shot(activity: Activity) -> bool {
    matches!(activity, Activity::LocalShot | Activity::ReceivedShot)
}
