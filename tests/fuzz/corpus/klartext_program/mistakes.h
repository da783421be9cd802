L X+
* - "
Q1 = ((((1
QS1 = "a
FN 77: X
~
