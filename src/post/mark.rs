//! Remarks that say what the moves after them are for.

use crate::toolpath::{Move, Rate, Role};

/// Writes a remark wherever the role changes.
#[derive(Default)]
pub(super) struct Marker {
    last: Option<Role>,
    passes: usize,
}

impl Marker {
    /// The remark due before a move of `role`, if any.
    pub(super) fn before(&mut self, role: Role) -> Option<String> {
        if self.last == Some(role) {
            return None;
        }
        self.last = Some(role);
        Some(match role {
            Role::Cut => {
                self.passes += 1;
                format!("PASS {}", self.passes)
            }
            Role::Link => "LINK".to_owned(),
        })
    }
}

/// The role that a remark announces; `None` for any other remark.
pub(super) fn announced(remark: &str) -> Option<Role> {
    let upper = remark.to_ascii_uppercase();
    match upper.split_whitespace().collect::<Vec<_>>()[..] {
        ["LINK"] => Some(Role::Link),
        ["PASS", number] if number.parse::<u32>().is_ok() => Some(Role::Cut),
        _ => None,
    }
}

/// The role of a move under the last remark; in a program that never said, whatever is fed cuts.
pub(super) fn role(announced: Option<Role>, rate: Rate) -> Role {
    announced.unwrap_or(match rate {
        Rate::Rapid => Role::Link,
        Rate::Feed(_) => Role::Cut,
    })
}

/// Whether a machine could make the move: all numbers finite, a feed above 0.
pub(super) fn is_possible(step: &Move) -> bool {
    let feeds = match step.rate {
        Rate::Rapid => true,
        Rate::Feed(feed) => feed > 0.0 && feed.is_finite(),
    };
    feeds && step.to.tip.is_finite() && step.to.axis.is_finite()
}
