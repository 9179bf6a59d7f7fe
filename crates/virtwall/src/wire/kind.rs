//! Kinds of messages.

use super::message::Message;

/// The kind of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum MessageKind {
    /// [`Message::Source`].
    Source,
    /// [`Message::Update`].
    Update,
    /// [`Message::Collect`].
    Collect,
    /// [`Message::Sums`].
    Sums,
    /// [`Message::StopSelecting`].
    StopSelecting,
    /// [`Message::Token`].
    Token,
    /// [`Message::Done`].
    Done,
    /// [`Message::WallPatch`].
    WallPatch,
}

impl MessageKind {
    /// Every kind.
    pub const ALL: [MessageKind; 8] = [
        MessageKind::Source,
        MessageKind::Update,
        MessageKind::Collect,
        MessageKind::Sums,
        MessageKind::StopSelecting,
        MessageKind::Token,
        MessageKind::Done,
        MessageKind::WallPatch,
    ];

    /// The kind of a message.
    pub fn of(message: &Message) -> MessageKind {
        match message {
            Message::Source(_) => MessageKind::Source,
            Message::Update(_) => MessageKind::Update,
            Message::Collect => MessageKind::Collect,
            Message::Sums(_) => MessageKind::Sums,
            Message::StopSelecting => MessageKind::StopSelecting,
            Message::Token(_) => MessageKind::Token,
            Message::Done => MessageKind::Done,
            Message::WallPatch(_) => MessageKind::WallPatch,
        }
    }

    /// Its name in reports and traces.
    pub fn name(self) -> &'static str {
        match self {
            MessageKind::Source => "source",
            MessageKind::Update => "update",
            MessageKind::Collect => "collect",
            MessageKind::Sums => "sums",
            MessageKind::StopSelecting => "stop selecting",
            MessageKind::Token => "token",
            MessageKind::Done => "done",
            MessageKind::WallPatch => "wall patch",
        }
    }
}
