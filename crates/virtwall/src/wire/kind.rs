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
    /// Every kind with its name in reports and traces, in the order of the variants.
    const NAMED: [(MessageKind, &'static str); 8] = [
        (MessageKind::Source, "source"),
        (MessageKind::Update, "update"),
        (MessageKind::Collect, "collect"),
        (MessageKind::Sums, "sums"),
        (MessageKind::StopSelecting, "stop selecting"),
        (MessageKind::Token, "token"),
        (MessageKind::Done, "done"),
        (MessageKind::WallPatch, "wall patch"),
    ];

    /// Every kind.
    pub fn all() -> impl Iterator<Item = MessageKind> {
        MessageKind::NAMED.into_iter().map(|(kind, _)| kind)
    }

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
        MessageKind::NAMED[self as usize].1
    }
}
