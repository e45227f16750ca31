//! Why a job ends without a result.

use crate::monitor::Cancelled;
use crate::strategy::StrategyError;
use crate::verify::VerifyError;

/// Why a job ends without a result.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum JobError {
    /// The specification is not valid JSON; the message names line and column.
    #[error("specification: {0}")]
    Syntax(String),
    /// A setting is wrong.
    #[error("{field}: {message}")]
    Field {
        /// Its path in the specification, as `cutter.diameter_mm`.
        field: String,
        /// What would be right.
        message: String,
    },
    /// The file cannot be used; the message says where and why.
    #[error("{0}")]
    Import(String),
    /// No path could be planned.
    #[error("{0}")]
    Strategy(String),
    /// The program could not be written or read back.
    #[error("{0}")]
    Post(String),
    /// Told to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl JobError {
    /// A setting that is wrong, and what would be right.
    pub fn field(field: &str, message: String) -> Self {
        Self::Field { field: field.into(), message }
    }

    /// A word for programs: `syntax`, `field`, `import`, `strategy`, `post` or `cancelled`.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Syntax(_) => "syntax",
            Self::Field { .. } => "field",
            Self::Import(_) => "import",
            Self::Strategy(_) => "strategy",
            Self::Post(_) => "post",
            Self::Cancelled(_) => "cancelled",
        }
    }

    /// The setting that is wrong, if one is.
    pub fn field_path(&self) -> Option<&str> {
        match self {
            Self::Field { field, .. } => Some(field),
            _ => None,
        }
    }
}

impl From<StrategyError> for JobError {
    fn from(error: StrategyError) -> Self {
        match error {
            StrategyError::Cancelled(cancelled) => Self::Cancelled(cancelled),
            #[cfg(feature = "flow")]
            StrategyError::Start(wrong) => Self::field("strategy.start_points_mm", wrong.to_string()),
            other => Self::Strategy(other.to_string()),
        }
    }
}

impl From<VerifyError> for JobError {
    fn from(error: VerifyError) -> Self {
        match error {
            VerifyError::Cancelled(cancelled) => Self::Cancelled(cancelled),
            other => Self::Post(format!("the program cannot be proven: {other}")),
        }
    }
}

/// The error as JSON `{code, message, field?}`, for programs.
pub fn error_json(error: &JobError) -> String {
    let mut object = serde_json::json!({ "code": error.code(), "message": error.to_string() });
    if let JobError::Field { field, message } = error {
        object["field"] = field.as_str().into();
        object["message"] = message.as_str().into();
    }
    object.to_string()
}
