"""Who may log in at the operator's page, as what, and with which password."""
