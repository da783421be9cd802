BEGIN PGM PRINT MM
Q1 = 25.0136
Q2 = -3
QS1 = "H7"
QS2 = ""
FN 16: F-PRINT mask.a / SCREEN:
FN 16: F-PRINT mask.a / out.txt
FN 16: F-PRINT mask.a / out.txt
FN 16: F-PRINT mask.a / SCLR:
FN 15: PRINT Q1/Q2/"text"
END PGM PRINT MM
