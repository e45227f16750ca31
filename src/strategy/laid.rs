//! Passes that were laid in one of several ways, compared with others, and finished if they are the best.

#[cfg(feature = "flow")]
use super::ease::eased;
use super::follow::{Part, followed};
use super::{Planned, StrategyError};
use crate::geometry::Uv;
use crate::monitor::Stage;
#[cfg(feature = "flow")]
use crate::posture::Rule;
#[cfg(not(feature = "flow"))]
use std::marker::PhantomData;

/// Passes that were laid.
pub(super) struct Laid<'a> {
    pub(super) planned: Planned,
    /// Whether they leave nothing above the limit wherever that was looked at.
    pub(super) is_whole: bool,
    /// The lines that they follow and other places to be looked at; none where those are of several families.
    #[cfg(feature = "flow")]
    lines: Option<(Part<'a>, Vec<Uv>)>,
    /// The page's first module eases nothing.
    #[cfg(not(feature = "flow"))]
    lines: PhantomData<Part<'a>>,
    /// The version of the rule by which the axis leans.
    #[cfg(feature = "flow")]
    pub(super) rule: Rule,
}

impl<'a> Laid<'a> {
    /// The passes on the lines of `part`, and on short ones for what they leave there and at `others`.
    pub(super) fn of(
        #[cfg(feature = "flow")] rule: Rule,
        part: Part<'a>,
        others: Vec<Uv>,
        stage: &Stage,
    ) -> Result<Self, StrategyError> {
        let parts = [part];
        let (planned, is_whole) = followed(&parts, &others, stage)?;
        Ok(Self {
            planned,
            is_whole,
            #[cfg(feature = "flow")]
            lines: parts.into_iter().next().zip(Some(others)),
            #[cfg(not(feature = "flow"))]
            lines: PhantomData,
            #[cfg(feature = "flow")]
            rule,
        })
    }

    /// The same of several families.
    #[cfg(feature = "flow")]
    pub(super) fn of_several(
        rule: Rule,
        mut parts: Vec<Part<'a>>,
        others: Vec<Uv>,
        stage: &Stage,
    ) -> Result<Self, StrategyError> {
        if parts.len() == 1 {
            return Self::of(rule, parts.remove(0), others, stage);
        }
        let (planned, is_whole) = followed(&parts, &others, stage)?;
        Ok(Self { planned, is_whole, lines: None, rule })
    }

    /// How long other passes may be at most to be better, mm: any length where these leave something.
    pub(super) fn most(&self) -> f64 {
        if self.is_whole { self.planned.length() } else { f64::INFINITY }
    }

    /// Whether these passes are shorter than `other`, or leave nothing and those do.
    pub(super) fn is_better(&self, other: &Self) -> bool {
        let is_shorter = self.planned.length() < other.planned.length();
        if self.is_whole == other.is_whole { is_shorter } else { self.is_whole }
    }

    /// The passes, postures eased where they leave nothing.
    #[cfg(feature = "flow")]
    pub(super) fn eased(self, stage: &Stage) -> Result<Planned, StrategyError> {
        Ok(match self.lines {
            Some((part, others)) if self.is_whole => eased(&part, &others, self.planned, stage)?,
            _ => self.planned,
        })
    }
}
