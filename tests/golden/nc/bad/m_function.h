; run: failed line 3: M51 is not available here; if the builder of the machine made it, say in the setup what it does: "m_functions":{"51":"ignore"}, or {"call":"TNC:\\oem\\m51.h"}
BEGIN PGM BAD MM
L X+0 FMAX M51
END PGM BAD MM
