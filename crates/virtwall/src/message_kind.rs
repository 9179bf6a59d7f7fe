//! What a message is about.

/// What a message is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum MessageKind {
    /// [`Message::Source`](crate::Message::Source).
    Source,
    /// [`Message::Update`](crate::Message::Update).
    Update,
    /// [`Message::Collect`](crate::Message::Collect).
    Collect,
    /// [`Message::Sums`](crate::Message::Sums).
    Sums,
    /// [`Message::StopSelecting`](crate::Message::StopSelecting).
    StopSelecting,
    /// [`Message::Token`](crate::Message::Token).
    Token,
    /// [`Message::Done`](crate::Message::Done).
    Done,
    /// [`Message::WallPatch`](crate::Message::WallPatch).
    WallPatch,
}

impl MessageKind {
    /// Every kind, in the order of the bytes with which messages begin.
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

    /// The kind of an encoded message.
    pub fn of(bytes: &[u8]) -> Option<MessageKind> {
        MessageKind::ALL.get(usize::from(*bytes.first()?)).copied()
    }

    /// Its name, for people.
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
